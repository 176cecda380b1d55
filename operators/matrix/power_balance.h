// Where the power of a field on patches goes. Of the power that leaves the unknowns, the rays of T that see them catch some, and
// the rest hits nothing. Of the power that arrives, the directional albedo of its cell is reflected. R conserves power to rounding,
// T only in expectation, because the rays that see a facet and the facet's own rays are two different estimates.
#pragma once

#include "operators/matrix/ray_table.h"
#include "operators/matrix/reflection_matrix.h"

namespace neumann {

// W, mean of the channels. Of one term.
struct PowerOfTerm {
    double emitted = 0.0;   // leaves the unknowns
    double left = 0.0;      // part of `emitted` that hits nothing, or sides that neither reflect nor emit
    double caught = 0.0;    // part of `emitted` that the rays of other facets see
    double absorbed = 0.0;  // part of `caught`
};

template <int C>
class PowerBalance {
public:
    PowerBalance(const RayTable& table, const ReflectionMatrix<C>& R);
    PowerOfTerm of(const ExitantVector<C>& term) const;

private:
    // The contribution of one unit of radiance of each unknown.
    typename ExitantVector<1>::Values emitted_, left_, caught_;
    typename ExitantVector<C>::Values absorbed_;
};

extern template class PowerBalance<1>;
extern template class PowerBalance<4>;

}  // namespace neumann
