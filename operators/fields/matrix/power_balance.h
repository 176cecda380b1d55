// Balances the power of a field on patches. Of the power that leaves the unknowns, the rays of T that see them catch some, and the
// rest hits nothing. Of the power that arrives, the directional albedo of its cell is reflected. R conserves power to rounding, T
// only in expectation, because the rays that see a facet and the facet's own rays are two different estimates. A chain (chains.h)
// carries the power that it takes from a side with unknowns from link to link, one bounce each.
//
// If several processes share the rows of T, each finds the power that leaves its own facets, arrives there and is seen
// from there: the sum over the processes is the balance.
#pragma once

#include "operators/fields/matrix/chains.h"
#include "operators/fields/matrix/ray_table.h"
#include "operators/fields/matrix/reflection_matrix.h"

#include <vector>

namespace neumann {

// The power of one term in W, as the mean of the channels.
struct PowerOfTerm {
    double emitted = 0.0;   // leaves surfaces
    double left = 0.0;      // part of `emitted` that hits nothing, or sides that neither reflect nor emit
    double caught = 0.0;    // part of `emitted` that the rays of other facets see
    double absorbed = 0.0;  // part of `caught`

    PowerOfTerm& operator+=(const PowerOfTerm& p) {
        emitted += p.emitted;
        left += p.left;
        caught += p.caught;
        absorbed += p.absorbed;
        return *this;
    }
};

template <int C>
class PowerBalance {
public:
    // Keeps references to the chains.
    PowerBalance(const RayTable& table, const ReflectionMatrix<C>& R, const Chains& chains);

    // Adds the power of term k to entry k, and the power that its chains carry on to later entries.
    void add(std::size_t k, const ExitantVector<C>& term, std::vector<PowerOfTerm>& power) const;
    // The power that arrives, in `caught` and `absorbed`.
    PowerOfTerm arriving(const IncidentVector<C>& means) const;

private:
    const PatchSpace* space_;
    const Chains* chains_;
    std::uint32_t begin_, end_;  // unknowns [begin_, end_) have rows
    // Contributions to the balance of one unit of radiance of each unknown.
    typename ExitantVector<1>::Values emitted_, left_, caught_;
    // kept_ is the absorbed part of the power that arrives in each unknown's cell.
    typename ExitantVector<C>::Values absorbed_, kept_;
};

extern template class PowerBalance<1>;
extern template class PowerBalance<4>;

}  // namespace neumann
