// The first terms of the series on a patch space: Le, and b = K Le by light sampling if the rays of T would hardly hit the lights.
#pragma once

#include "core/scene/scene.h"
#include "operators/fields/matrix/reflection_matrix.h"
#include "operators/fields/matrix/some_facets.h"

namespace neumann {

// The mean of Le over each patch and cell of directions; 0 at facets that are not in `facets`.
template <int C>
ExitantVector<C> emitted_light(const Scene& scene, const PatchSpace& space, const SomeFacets& facets = {});

// T Le, the g in K Le = R g, at facets where R is not 0. Its means over the cells are estimated with `samples` pairs of
// a point on the facet and one on a light: Σ Le V G / pdf / (projected solid angle of the cell).
template <int C>
IncidentVector<C> arriving_light(const Scene& scene, const ReflectionMatrix<C>& R, std::uint32_t samples, std::uint64_t seed,
                                 const SomeFacets& facets = {});

// The expected number of a facet's rays that hit a light, if every point of the scene were hit with equal probability.
double rays_that_meet_lights(const Scene& scene, std::uint32_t rays);
// If at least this many rays of a facet hit a light, K Le is computed with T instead of light sampling.
constexpr double enough_rays = 8.0;

}  // namespace neumann
