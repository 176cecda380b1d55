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
#include "operators/paths/walk/continuation.h"
#include "operators/paths/walk/diffuse_packet.h"
#include "operators/paths/walk/first_vertices.h"
#include "operators/paths/walk/observer.h"
#include "operators/paths/walk/shadow_rays.h"
#include "operators/paths/walk/term_samples.h"
#include "operators/paths/walk/walk_settings.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace neumann {

// Samples the terms from 1 on of walks that stand at their first vertices. `T` has first_hits() and visible() like
// Geometry; samplers[i] gives the random numbers of walk i. `observer` is described in observer.h.
template <class Transport, class Sampler, class Continuation = MaterialContinuation, class Observer = NoObserver>
NEUMANN_HOT void walk_on(const Scene& scene, const Transport& T, const DirectLightSampler& direct, const WalkSettings& settings,
                         std::span<Sampler> samplers, Walkers& walkers, TermSamples& out, const Continuation& continuation = {},
                         const Observer& observer = {}) {
    const Emitters& emitters = scene.emitters;
    const LeftOut& left_out = settings.left_out;
    const Ending ending = settings.ending();
    const int N = settings.bounces;
    const std::size_t quantities = static_cast<std::size_t>(N) + 2;
    double share = 1.0;  // weight of a walk: 1 over the number of walks from its first vertex
    const auto find = [&](std::uint32_t i, std::size_t q, const Rgb& x) {
        out.quantities[i * quantities + q] += x * share;
        observer.finds(i, q, x * share);
    };

    DiffusePacket packet;
    const Split& split = settings.split;
    VertexDataOfWalks<Continuation> vertex_data(walkers.walker.size());
    if constexpr (Continuation::joins_points) walkers.next.resize(walkers.walker.size());
    if (split.walks > 1) walkers.remember_first();
    share = 1.0 / split.walks;
    for (int copy = 0; copy < split.walks; ++copy) {
        if (copy > 0) walkers.return_to_first();

        // L = Le + K L: apply K once more, then add Le at the next vertex.
        for (int bounce = 1; ending.reach(bounce, walkers, samplers, out.given_up); ++bounce) {
            const auto q = static_cast<std::size_t>(std::min(bounce, N + 1));
            const bool first = bounce == 1, wants_light_only = ending.is_last(bounce);
            const double directions_per_light_sample = first ? static_cast<double>(split.walks) / split.lights : 1.0;
            const std::size_t light_samples = direct.light_samples() * std::size_t(!first ? 1 : copy == 0 ? split.lights : 0);
            vertex_data.find(continuation, walkers, std::max(N - bounce, 0));

            // R samples the lights and, along with the last light sample, the next direction. T finds which light
            // samples are visible.
            for (std::size_t light_sample = 1; light_sample <= std::max<std::size_t>(light_samples, 1); ++light_sample) {
                const auto reflect = [&](Walker& w, std::uint32_t i) {
                    const SurfaceSide side = scene.materials.side(w.x, w.wo);
                    if (!side.bsdf) return false;
                    const Vec3 wo = side.p.frame.to_local(w.wo);
                    const auto& distribution = continuation.at(side, vertex_data[i]);
                    if (light_samples > 0)
                        choose_light_sample(direct, light_sample % direct.light_samples(), distribution,
                                            directions_per_light_sample, side, wo, samplers[i], w);
                    if (light_sample < light_samples) return true;
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
                        if (!material) return reflect(w, i);
                        packet.add(w, *material, direct, samplers[i]);
                        if (packet.is_full()) packet.reflect(direct, directions_per_light_sample);
                        return true;
                    });
                    packet.reflect(direct, directions_per_light_sample);
                } else {
                    walkers.keep_if(reflect);
                }
                if (light_samples > 0)
                    out.rays[q] += cast_shadow_rays(scene, T, direct, left_out, bounce, walkers, observer,
                                                    [&](std::uint32_t i, const Rgb& light) { find(i, q, light); });
            }

            // Keeps the walks whose ray is needed: for this bounce's light, for a further bounce, or for the rest.
            if (wants_light_only && left_out.rays_for_light) break;
            const bool only_mirrors = wants_light_only && !direct.counts_what_is_hit();
            walkers.keep_if([&](Walker& w, std::uint32_t i) {
                if (w.pdf == 0.0 || is_black(w.beta) || (only_mirrors && w.pdf != delta_pdf)) return false;
                return ending.live(bounce, w, w.reflected, samplers[i]);
            });

            // T follows the direction. The light that it hits, Le, is added.
            const auto next_points = [&](std::size_t k, std::size_t n, const auto& hit) {
                if (left_out.rays_from_surfaces) return std::uint32_t{0};
                if constexpr (Continuation::joins_points)
                    return walkers.join_next(T, k, n, hit);
                else
                    return walkers.first_hits(T, k, n, hit);
            };
            if (!left_out.rays_from_surfaces) out.rays[q] += walkers.alive.size();
            walkers.advance(bounce, observer, next_points, [&](Walker& w, std::uint32_t i) {
                if (Continuation::joins_points && w.x.is_infinite()) return false;
                w.wo = -w.w;
                if ((direct.counts_what_is_hit() || w.pdf == delta_pdf) && emitters.is_emitter(w.x.shape)) {
                    const Rgb emitted = emitters.emitted(w.x, w.wo);
                    if (!is_black(emitted))
                        find(i, q, w.beta * emitted * direct.weight_of_hit(w.pdf * directions_per_light_sample, w.from, w.w, w.x));
                }
                return !w.x.is_infinite();
            });
        }
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
