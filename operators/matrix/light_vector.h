// Where the series on a patch space begins: Le, and b = K Le found by light sampling where T's rays would hardly meet the lights.
#pragma once

#include "core/scene/scene.h"
#include "operators/matrix/reflection_matrix.h"

namespace neumann {

// Le: the mean over each patch and cell of directions.
template <int C>
ExitantVector<C> emitted_light(const Scene& scene, const PatchSpace& space);

// K Le as R of the means of T Le over the cells, which `samples` points on lights and as many on each facet tell:
// Σ Le V G / pdf / (projected solid angle of the cell).
template <int C>
ExitantVector<C> direct_light(const Scene& scene, const ReflectionMatrix<C>& R, std::uint32_t samples, std::uint64_t seed);

// The rays of a facet that meet a light, on average over the scene, were every point as likely.
double rays_that_meet_lights(const Scene& scene, std::uint32_t rays);
// So many have to, for K Le to be T's own.
constexpr double enough_rays = 8.0;

}  // namespace neumann
