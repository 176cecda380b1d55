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

// R chooses the walk's light sample and stores it in w.asked. Its MIS weight is against the pdf of `distribution`
// (continuation.h), which draws `directions` directions for each light sample.
template <class Distribution, class Sampler>
void choose_question(const DirectLightSampler& direct, std::size_t question, const Distribution& distribution, double directions,
                     const SurfaceSide& side, const Vec3& wo, Sampler& sampler, Walker& w) {
    w.asked.value = Rgb(0.0);
    const LightQuestion q = direct.ask(side, sampler, question);
    if (!(q.pdf > 0.0)) return;
    const Vec3 wi = side.p.frame.to_local(q.w);
    const double pdf_of_walk = direct.is_weighted() ? distribution.pdf(side, wo, wi, q.point) * directions : 0.0;
    w.asked.value = reflected_light(w.beta, side, wo, wi, q.weight) *
                    (std::abs(wi.z) * direct.weight_of_answer(q.pdf, pdf_of_walk) * directions);
    w.asked.y = q.point;
    w.asked.w = q.w;
}

// T casts the shadow rays of the light samples and calls found(walk, value) for those that are visible. Returns the
// number of rays cast.
template <class Transport, class AnyWalkers, class Observer, class Found>
std::size_t answer(const Scene& scene, const Transport& T, const DirectLightSampler& direct, const LeftOut& left_out, int bounce,
                   AnyWalkers& walkers, const Observer& observer, const Found& found) {
    auto& asking = walkers.asking;
    asking.resize(walkers.alive.size());
    auto* const all = walkers.walker.data();
    const bool asks_directions = direct.asks_directions();
    std::size_t asked = 0;
    for (const std::uint32_t i : walkers.alive) {
        const Walker& w = all[i];
        const bool is_asked = !is_black(w.asked.value),
                   is_known = is_asked && !asks_directions && is_in_sight(left_out, w.x, w.asked.y);
        if (is_known) found(i, w.asked.value);
        asking[asked] = i;
        asked += is_asked && !is_known;
    }
    asking.resize(asked);
    const auto at = [all, some = asking.data()](std::size_t k) -> Walker& { return all[some[k]]; };
    if (asks_directions) {
        for (std::size_t k = 0; k < asking.size(); k += RayCaster::packet_size) {
            const std::size_t n = std::min(RayCaster::packet_size, asking.size() - k);
            const std::uint32_t hit = T.first_hits(
                n, [&](std::size_t j) { return std::pair<const SurfacePoint&, const Vec3&>(at(k + j).x, at(k + j).asked.w); },
                [&](std::size_t j) -> SurfacePoint& { return at(k + j).asked.y; });
            for (std::size_t j = 0; j < n; ++j) {
                AskedLight& asked = at(k + j).asked;
                if (!(hit >> j & 1u)) asked.y.shape = SurfacePoint::infinity;
                observer.asks(asking[k + j], false, bounce, at(k + j).x, asked.w, asked.y, (hit >> j & 1u) != 0);
                found(asking[k + j], asked.value * scene.emitters.emitted(asked.y, -asked.w));
            }
        }
    } else {
        ask_visibility(
            T, asking.size(), bounce == 1 ? RayCaster::Rays::alike : RayCaster::Rays::any,
            [&](std::size_t k) { return std::pair<const SurfacePoint&, const SurfacePoint&>(at(k).x, at(k).asked.y); },
            [&](std::size_t k, bool seen) {
                const Walker& w = at(k);
                observer.asks(asking[k], false, bounce, w.x, w.asked.w, w.asked.y, seen);
                if (seen) found(asking[k], w.asked.value);
            });
    }
    return asking.size();
}

}  // namespace neumann
