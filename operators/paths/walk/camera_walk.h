// The walk of all methods whose paths start at the camera alone: L = Le + K L, one reflection after the other, for many walks
// together.
//
//     R gives each walk its direction, and takes light samples    steps.reflect(bounce, q), e.g. by sample_reflections()
//     T follows the directions                                    steps.find_next(q, k, n, point), e.g. by Together::first_hits()
//     Le at the points that are hit is added                      steps.find(i, q, light)
//
// Light that is found after `bounce` reflections belongs to bounce q = min(bounce, N + 1): N + 1 is the rest.
#pragma once

#include "operators/paths/walk/continuation.h"
#include "operators/paths/walk/observer.h"
#include "operators/paths/walk/shadow_rays.h"
#include "operators/paths/walk/walk_settings.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace neumann {

// What a kind of walk may do in its own way. Its steps derive from this, hide what they change, and add
//
//     bool reflect(int bounce, std::size_t q)                             applies R; false: all walks end here
//     void find(std::uint32_t walk, std::size_t q, const Rgb& light)      adds light to a walk's sample of bounce q
template <class AnyWalkers>
struct WalkSteps {
    const Scene& scene;
    const DirectLightSampler& direct;
    const WalkSettings& settings;
    AnyWalkers& walkers;
    std::span<std::uint64_t> rays;  // of each bounce and the rest

    // Whether a walk that has been reflected needs a ray.
    bool needs_ray(const Walker&, std::uint32_t, int /*bounce*/) const { return true; }
    // Finds the next points of the walks alive[k … k + n), writes them to point(j), and counts the rays. Returns a bit mask of
    // those found.
    template <class PointAt>
    std::uint32_t find_next(std::size_t q, std::size_t k, std::size_t n, const PointAt& point) const {
        rays[q] += n;
        return walkers.first_hits(scene.geometry, k, n, point);
    }
    // Whether the light of what a walk has hit counts; and the number of directions for each light sample where it came from.
    bool counts_hit(const Walker& w, std::uint32_t) const { return direct.counts_what_is_hit() || w.pdf == delta_pdf; }
    double directions_per_light_sample(const Walker&) const { return 1.0; }
    // The weight of light that is hit, relative to that of what is found later.
    double part_of_hits(const Walker&) const { return 1.0; }
    // Whether the walk goes on from the point that it has hit, which is not infinite.
    bool goes_on(Walker&, std::uint32_t, int /*bounce*/) const { return true; }
};

// Continues walks from their first vertices. samplers[i] gives the random numbers of walk i.
template <class Samplers, class AnyWalkers, class Steps, class Observer>
void camera_walk(Samplers& samplers, AnyWalkers& walkers, Steps& steps, std::uint64_t& given_up, const Observer& observer) {
    const Emitters& emitters = steps.scene.emitters;
    const Ending ending = steps.settings.ending();
    for (int bounce = 1; ending.reach(bounce, walkers, samplers, given_up); ++bounce) {
        const auto q = static_cast<std::size_t>(std::min(bounce, steps.settings.bounces + 1));
        if (!steps.reflect(bounce, q)) return;
        walkers.keep_if([&](auto& w, std::uint32_t i) {
            return w.pdf != 0.0 && !is_black(w.beta) && steps.needs_ray(w, i, bounce) &&
                   ending.live(bounce, w, w.reflected, samplers[i]);
        });
        walkers.advance(
            bounce, observer, [&](std::size_t k, std::size_t n, const auto& point) { return steps.find_next(q, k, n, point); },
            [&](auto& w, std::uint32_t i) {
                w.wo = -w.w;
                if (steps.counts_hit(w, i) && emitters.is_emitter(w.x.shape)) {
                    const Rgb emitted = emitters.emitted(w.x, w.wo);
                    if (!is_black(emitted))
                        steps.find(i, q,
                                   w.beta * emitted * steps.part_of_hits(w) *
                                       steps.direct.weight_of_hit(w.pdf * steps.directions_per_light_sample(w), w.from, w.w, w.x));
                }
                return !w.x.is_infinite() && steps.goes_on(w, i, bounce);
            });
    }
}

// R at the vertices of walks: samples the lights and, along with the last light sample, the next direction. T finds which light
// samples are visible. takes_light(i, w, side, number) is called for number = 1 … max(light samples, 1), even if there are none; it
// returns whether the walk takes the sample.
template <class Steps, class Samplers, class TakesLight, class Observer>
void sample_reflections(Steps& steps, Samplers& samplers, int bounce, std::size_t q, const TakesLight& takes_light,
                        const Observer& observer) {
    const std::size_t light_samples = std::max<std::size_t>(steps.direct.light_samples(), 1);
    for (std::size_t number = 1; number <= light_samples; ++number) {
        steps.walkers.keep_if([&](Walker& w, std::uint32_t i) {
            const SurfaceSide side = steps.scene.materials.side(w.x, w.wo);
            if (!side.bsdf) return false;
            const Vec3 wo = side.p.frame.to_local(w.wo);
            w.shadow_ray.value = Rgb(0.0);
            if (takes_light(i, w, side, number) && steps.direct.light_samples() > 0)
                choose_light_sample(steps.direct, {number % light_samples}, MaterialContinuation(), 1.0, side, wo, samplers[i], w);
            if (number == light_samples) w.leave(side, MaterialContinuation().sample(side, wo, samplers[i]));
            return true;
        });
        steps.rays[q] += cast_shadow_rays(steps.scene, steps.scene.geometry, steps.direct, LeftOut(), bounce, steps.walkers,
                                          observer, [&](std::uint32_t i, const Rgb& light) { steps.find(i, q, light); });
    }
}

}  // namespace neumann
