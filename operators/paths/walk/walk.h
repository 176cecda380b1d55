// One random walk from the camera gives a sample of every term at once: at its i-th vertex it has been reflected i
// times, so the light emitted there is a sample of K^i Le.
//
//     K^i Le (x0, ω0) = E[ β_i Le(x_i, ω_i) ],   β_i = Π f cosθ / pdf over the i reflections
//
// The directions are sampled from the BSDF, or by another continuation (continuation.h).
//
// The last reflection may instead sample the lights (shadow_rays.h), or do both. After a mirror only the direction can find a
// light, and what it finds has weight 1 whatever the strategy.
#pragma once

#include "core/base/hot.h"
#include "operators/paths/walk/camera_walk.h"
#include "operators/paths/walk/diffuse_packet.h"
#include "operators/paths/walk/first_vertices.h"
#include "operators/paths/walk/term_samples.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace neumann {

// The steps of walks whose directions `continuation` samples, and whose rays `T` casts. `copy`: of a walk that is split at its
// first vertex (Split).
template <class Transport, class Sampler, class Continuation, class Observer>
struct ContinuedSteps : WalkSteps<Walkers> {
    const Transport& T;
    std::span<Sampler> samplers;
    TermSamples& out;
    const Continuation& continuation;
    const Observer& observer;
    VertexDataOfWalks<Continuation> vertex_data{walkers.walker.size()};
    DiffusePacket packet = {};
    int copy = 0;
    double share = 1.0 / settings.split.walks;  // weight of a walk
    double directions_of_bounce = 1.0;          // for each light sample

    void find(std::uint32_t i, std::size_t q, const Rgb& x) {
        out.quantities[i * (static_cast<std::size_t>(settings.bounces) + 2) + q] += x * share;
        observer.finds(i, q, x * share);
    }
    bool reflect(int bounce, std::size_t q) {
        const bool first = bounce == 1;
        const Split& split = settings.split;
        directions_of_bounce = first ? static_cast<double>(split.walks) / split.lights : 1.0;
        const std::size_t light_samples = direct.light_samples() * static_cast<std::size_t>(!first      ? 1
                                                                                            : copy == 0 ? split.lights
                                                                                                        : 0);
        vertex_data.find(continuation, walkers, std::max(settings.bounces - bounce, 0));
        for (std::size_t number = 1; number <= std::max<std::size_t>(light_samples, 1); ++number) {
            const auto reflect_one = [&](Walker& w, std::uint32_t i) {
                const SurfaceSide side = scene.materials.side(w.x, w.wo);
                if (!side.bsdf) return false;
                const Vec3 wo = side.p.frame.to_local(w.wo);
                const auto& distribution = continuation.at(side, vertex_data[i]);
                if (light_samples > 0)
                    choose_light_sample(direct,
                                        {number % direct.light_samples(), static_cast<int>((number - 1) / direct.light_samples()),
                                         first ? direct.strata(split.lights) : 1},
                                        distribution, directions_of_bounce, side, wo, samplers[i], w);
                if (number < light_samples) return true;
                BsdfSample sampled;
                if constexpr (Continuation::joins_points)
                    sampled = distribution.sample(side, wo, samplers[i], walkers.next[i]);
                else
                    sampled = distribution.sample(side, wo, samplers[i]);
                w.leave(side, sampled);
                return true;
            };
            if (std::is_same_v<Continuation, MaterialContinuation> && light_samples == 1 && DiffusePacket::fits(direct)) {
                walkers.keep_if([&](Walker& w, std::uint32_t i) {
                    const Diffuse* const material = DiffusePacket::material(scene.materials, w);
                    if (!material) return reflect_one(w, i);
                    packet.add(w, *material, direct, samplers[i]);
                    if (packet.is_full()) packet.reflect(direct, directions_of_bounce);
                    return true;
                });
                packet.reflect(direct, directions_of_bounce);
            } else {
                walkers.keep_if(reflect_one);
            }
            if (light_samples > 0)
                rays[q] += cast_shadow_rays(scene, T, direct, settings.left_out, bounce, walkers, observer,
                                            [&](std::uint32_t i, const Rgb& light) { find(i, q, light); });
        }
        return !(settings.ending().is_last(bounce) && settings.left_out.rays_for_light);
    }
    // A ray is needed for this bounce's light, for a further bounce, or for the rest.
    bool needs_ray(const Walker& w, std::uint32_t, int bounce) const {
        return direct.counts_what_is_hit() || w.pdf == delta_pdf || !settings.ending().is_last(bounce);
    }
    template <class PointAt>
    std::uint32_t find_next(std::size_t q, std::size_t k, std::size_t n, const PointAt& point) const {
        if (settings.left_out.rays_from_surfaces) return 0;
        rays[q] += n;
        if constexpr (Continuation::joins_points)
            return walkers.join_next(T, k, n, point);
        else
            return walkers.first_hits(T, k, n, point);
    }
    // A vertex that is joined and not visible is no light that surrounds the scene.
    bool counts_hit(const Walker& w, std::uint32_t i) const {
        return !(Continuation::joins_points && w.x.is_infinite()) && WalkSteps::counts_hit(w, i);
    }
    double directions_per_light_sample(const Walker&) const { return directions_of_bounce; }
};

// Samples the terms from 1 on of walks that stand at their first vertices. `T` has first_hits() and visible() like
// Geometry; samplers[i] gives the random numbers of walk i. `observer` is described in observer.h.
template <class Transport, class Sampler, class Continuation = MaterialContinuation, class Observer = NoObserver>
NEUMANN_HOT void walk_on(const Scene& scene, const Transport& T, const DirectLightSampler& direct, const WalkSettings& settings,
                         std::span<Sampler> samplers, Walkers& walkers, TermSamples& out, const Continuation& continuation = {},
                         const Observer& observer = {}) {
    if constexpr (Continuation::joins_points) walkers.next.resize(walkers.walker.size());
    if (settings.split.walks > 1) walkers.remember_first();
    ContinuedSteps<Transport, Sampler, Continuation, Observer> steps{
        {scene, direct, settings, walkers, out.rays}, T, samplers, out, continuation, observer};
    for (; steps.copy < settings.split.walks; ++steps.copy) {
        if (steps.copy > 0) walkers.return_to_first();
        camera_walk(samplers, walkers, steps, out.given_up, observer);
    }
}

// Samples all terms along some camera rays: T finds the first vertices, where Le is added, and walk_on() samples the others.
template <class Transport, class Sampler, class Continuation = MaterialContinuation, class Observer = NoObserver>
void walk(const Scene& scene, const Transport& T, const DirectLightSampler& direct, const WalkSettings& settings,
          std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers& walkers, TermSamples& out,
          const Continuation& continuation = {}, const Observer& observer = {}) {
    const std::size_t quantities = static_cast<std::size_t>(settings.bounces) + 2;
    find_first_vertices(scene, T, rays, walkers, out.rays[0], observer, [&](std::uint32_t i, const Rgb& Le) {
        out.quantities[i * quantities] += Le;
        observer.finds(i, 0, Le);
    });
    walk_on(scene, T, direct, settings, samplers, walkers, out, continuation, observer);
}

}  // namespace neumann
