// ⟨f, g⟩ = ∫∫ f g n² |cos θ| dω dA, in which T and R have their adjoints: over unknowns, and over the rays of a table.
#pragma once

#include "operators/matrix/transport_matrix.h"

namespace neumann {

template <int C>
Channels<C> inner_product(const PatchSpace& space, const ExitantVector<C>& f, const ExitantVector<C>& g) {
    Channels<C> sum = Channels<C>::Zero(C);
    for (const Facet& facet : space.facets())
        for (std::uint32_t u = facet.first; u < facet.first + facet.cells.size(); ++u)
            sum += f.col(u) * g.col(u) * space.measure(facet);
    return sum;
}

// `a` and `b` answer [ray] with what arrives along it.
template <int C, class A, class B>
Channels<C> inner_product(const RayTable& table, const A& a, const B& b) {
    Channels<C> sum = Channels<C>::Zero(C);
    for (std::uint32_t f = 0; f < table.space().facets().size(); ++f)
        for (std::size_t ray = table.first_ray(f); ray < table.first_ray(f + 1); ++ray)
            sum += Channels<C>(a[ray]) * Channels<C>(b[ray]) * table.measure(f);
    return sum;
}

}  // namespace neumann
