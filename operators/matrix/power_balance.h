// Where the power of a field on patches goes: of what leaves the unknowns, some meets others, as the rays of T tell that see them,
// and the rest meets nothing; of what arrives, the directional albedo of the cell where it does is reflected. R keeps account to
// rounding; T does on average, for what the rays of all facets see of one and what its own rays see are two estimates.
#pragma once

#include "operators/matrix/ray_table.h"
#include "operators/matrix/reflection_matrix.h"

namespace neumann {

// W, mean of the channels. Of one term.
struct PowerOfTerm {
    double emitted = 0.0;   // leaves the unknowns
    double left = 0.0;      // of it, towards nothing, or sides that neither reflect nor shine
    double caught = 0.0;    // of it, by the rays of other facets
    double absorbed = 0.0;  // of what is caught
};

template <int C>
class PowerBalance {
public:
    PowerBalance(const RayTable& table, const ReflectionMatrix<C>& R);
    PowerOfTerm of(const ExitantVector<C>& term) const;

private:
    // What one unit of radiance of each unknown adds.
    typename ExitantVector<1>::Values emitted_, left_, caught_;
    typename ExitantVector<C>::Values absorbed_;
};

extern template class PowerBalance<1>;
extern template class PowerBalance<4>;

}  // namespace neumann
