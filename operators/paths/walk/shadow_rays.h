// Direct light at a vertex x that a path has reached with throughput β: the last reflection R chooses a light sample,
// and T casts its shadow ray.
//
//     K Le:   β fs(ω → ωo) |cosθ| Le(y, −ω) V(x, y) / pdf(ω)
#pragma once

#include "operators/paths/walk/direct_light.h"
#include "operators/paths/walk/visibility.h"
#include "operators/paths/walk/walker.h"

namespace neumann {

// The same product without V and |cosθ|. `light` is Le / pdf.
inline Rgb reflected_light(const Rgb& beta, const SurfaceSide& side, const Vec3& wo, const Vec3& wi, const Rgb& light) {
    return beta * eval(*side.bsdf, side.p, wo, wi) * light;
}

// R chooses the walk's light sample and stores it in w.shadow_ray. Its MIS weight is against the pdf of `distribution`
// (continuation.h), which draws `directions` directions for each light sample.
template <class Distribution, class Sampler>
void choose_light_sample(const DirectLightSampler& direct, const LightSampleNumber& number, const Distribution& distribution,
                         double directions, const SurfaceSide& side, const Vec3& wo, Sampler& sampler, Walker& w) {
    w.shadow_ray.value = Rgb(0.0);
    const LightSample light = direct.sample(side, sampler, number);
    if (!(light.pdf > 0.0)) return;
    const Vec3 wi = side.p.frame.to_local(light.w);
    const double pdf_of_walk = direct.is_weighted() ? distribution.pdf(side, wo, wi, light.point) * directions : 0.0;
    w.shadow_ray.value = reflected_light(w.beta, side, wo, wi, light.weight) *
                         (std::abs(wi.z) * direct.weight_of_light_sample(light.pdf, pdf_of_walk) * directions);
    w.shadow_ray.y = light.point;
    w.shadow_ray.w = light.w;
}

// T casts the shadow rays of the light samples and calls found(walk, value) for those that are visible. Returns the
// number of rays cast.
template <class Transport, class AnyWalkers, class Observer, class Found>
std::size_t cast_shadow_rays(const Scene& scene, const Transport& T, const DirectLightSampler& direct, const LeftOut& left_out,
                             int bounce, AnyWalkers& walkers, const Observer& observer, const Found& found) {
    auto& with_shadow_ray = walkers.with_shadow_ray;
    with_shadow_ray.resize(walkers.alive.size());
    auto* const all = walkers.walker.data();
    const bool samples_directions = direct.samples_directions();
    std::size_t count = 0;
    for (const std::uint32_t i : walkers.alive) {
        const Walker& w = all[i];
        const bool is_needed = !is_black(w.shadow_ray.value),
                   is_known = is_needed && !samples_directions && is_in_sight(left_out, w.x, w.shadow_ray.y);
        if (is_known) found(i, w.shadow_ray.value);
        with_shadow_ray[count] = i;
        count += is_needed && !is_known;
    }
    with_shadow_ray.resize(count);
    const auto at = [all, some = with_shadow_ray.data()](std::size_t k) -> Walker& { return all[some[k]]; };
    if (samples_directions) {
        for (std::size_t k = 0; k < with_shadow_ray.size(); k += RayCaster::packet_size) {
            const std::size_t n = std::min(RayCaster::packet_size, with_shadow_ray.size() - k);
            const std::uint32_t hit = T.first_hits(
                n, [&](std::size_t j) { return std::pair<const SurfacePoint&, const Vec3&>(at(k + j).x, at(k + j).shadow_ray.w); },
                [&](std::size_t j) -> SurfacePoint& { return at(k + j).shadow_ray.y; });
            for (std::size_t j = 0; j < n; ++j) {
                ShadowRay& ray = at(k + j).shadow_ray;
                if (!(hit >> j & 1u)) ray.y.shape = SurfacePoint::infinity;
                observer.casts_shadow_ray(with_shadow_ray[k + j], false, bounce, at(k + j).x, ray.w, ray.y, (hit >> j & 1u) != 0);
                found(with_shadow_ray[k + j], ray.value * scene.emitters.emitted(ray.y, -ray.w));
            }
        }
    } else {
        test_visibility(
            T, with_shadow_ray.size(), bounce == 1 ? RayCaster::Rays::alike : RayCaster::Rays::any,
            [&](std::size_t k) { return std::pair<const SurfacePoint&, const SurfacePoint&>(at(k).x, at(k).shadow_ray.y); },
            [&](std::size_t k, bool seen) {
                const Walker& w = at(k);
                observer.casts_shadow_ray(with_shadow_ray[k], false, bounce, w.x, w.shadow_ray.w, w.shadow_ray.y, seen);
                if (seen) found(with_shadow_ray[k], w.shadow_ray.value);
            });
    }
    return with_shadow_ray.size();
}

}  // namespace neumann
