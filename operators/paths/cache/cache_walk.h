// Walks that end where an irradiance cache is read: those from the camera, and the rays of the records themselves. A
// walk goes on from surfaces that are not diffuse, and from diffuse surfaces where no record stands nearby. At the
// first vertex x where one does, it takes light samples as other walks do (shadow_rays.h) and reads
//
//     K^{k+1} Le (x, ωo) = ρ(x)/π E_k(x),   E_k = ∫ (T K^k Le) cosθ dω,   k ≥ 1
//
// so that a record of bounce k, read by a walk after b reflections, including that at x, belongs to bounce b + k. The
// rays of records read records: E_k is made of direct light and of E_{k−1}, as K^i Le = K (K^{i−1} Le).
#pragma once

#include "operators/paths/walk/plain_walk.h"

#include <optional>

namespace neumann {

// ρ/π on a side if the cache is read there, which is the case for diffuse sides.
inline std::optional<Rgb> diffuse_reflection(const SurfaceSide& side) {
    const auto* diffuse = std::get_if<Diffuse>(side.bsdf);
    return diffuse ? std::optional(diffuse->reflectance(side.p) * inv_pi) : std::nullopt;
}

// A plain_walk() that ends where reads(i, walker, normal, weight, b) returns true, because the cache was read at the
// walker's vertex. `weight` is β ρ/π, the weight of the irradiance read.
template <class Reads, class Find, class Observer = NoObserver>
void walk_to_records(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& settings,
                     std::span<Sampler> samplers, PlainWalkers& walkers, std::span<std::uint64_t> rays, std::uint64_t& given_up,
                     const Reads& reads, const Find& find, const Observer& observer = {}) {
    const PlainWalkCalls calls{.reads =
                                   [&](std::uint32_t i, const Walker& w, const SurfaceSide& side, int bounce) {
                                       const auto reflection = diffuse_reflection(side);
                                       return reflection && reads(i, w, side.p.frame.n, w.beta * *reflection, bounce);
                                   },
                               .find = find};
    plain_walk(scene, direct, settings, {samplers}, walkers, rays, given_up, calls, observer);
}

}  // namespace neumann
