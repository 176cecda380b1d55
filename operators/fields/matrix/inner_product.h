// ⟨f, g⟩ = ∫∫ f g n² |cos θ| dω dA, for two exitant or two incident fields. T* and R* are the adjoints in this inner product.
#pragma once

#include "operators/fields/matrix/patch_field.h"
#include "operators/fields/patches/patch_space.h"

namespace neumann {

template <class Side, int C>
Channels<C> inner_product(const PatchSpace& space, const PatchField<Side, C>& f, const PatchField<Side, C>& g) {
    Channels<C> sum = Channels<C>::Zero(C);
    for (const Facet& facet : space.facets())
        for (std::uint32_t u = facet.first; u < facet.first + facet.cells.size(); ++u)
            sum += f.col(u) * g.col(u) * space.measure(facet);
    return sum;
}

// The étendue m_u of each unknown: ⟨f, g⟩ = Σ m_u f_u g_u.
inline Vector measure(const PatchSpace& space) {
    Vector m(space.size());
    for (const Facet& facet : space.facets()) m.segment(facet.first, facet.cells.size()).setConstant(space.measure(facet));
    return m;
}

}  // namespace neumann
