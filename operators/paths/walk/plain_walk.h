// The walk of walk.h in its plainest form, for walks that change their number or end before the light does. Before each
// reflection `branches(bounce)` may replace the walkers that are alive. At each vertex `reads(i, walker, side, bounce)`
// returns whether the walk ends, after the direct light of this vertex, at the next vertex. Afterwards walkers.reads is
// true for walks that ended so, and their x is the next vertex. Leaves nothing out.
#pragma once

#include "core/base/hot.h"
#include "operators/paths/walk/continuation.h"
#include "operators/paths/walk/observer.h"
#include "operators/paths/walk/shadow_rays.h"
#include "operators/paths/walk/walk_settings.h"

#include <algorithm>
#include <span>
#include <vector>

namespace neumann {

struct PlainWalkers : Walkers {
    std::vector<char> reads;  // whether the walk ends at the next vertex that it finds
};

// Continues walks from their first vertices. samplers[i] gives the random numbers of walker i; find(i, q, light) adds
// light to bounce q, or to the rest, q = N + 1. Counts the rays of each.
template <class Samplers, class AnyWalkers, class Branches, class Reads, class Find, class Observer = NoObserver>
NEUMANN_HOT void plain_walk(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& settings, Samplers& samplers,
                            AnyWalkers& walkers, std::span<std::uint64_t> rays, std::uint64_t& given_up, const Branches& branches,
                            const Reads& reads, const Find& find, const Observer& observer = {}) {
    const Geometry& T = scene.geometry;
    const Emitters& emitters = scene.emitters;
    const Ending ending = settings.ending();
    const int N = settings.bounces;
    walkers.reads.assign(walkers.walker.size(), 0);
    for (int bounce = 1; ending.reach(bounce, walkers, samplers, given_up); ++bounce) {
        const auto q = static_cast<std::size_t>(std::min(bounce, N + 1));
        branches(bounce);
        walkers.reads.resize(walkers.walker.size());
        // R samples the lights and, along with the last light sample, the next direction.
        const std::size_t light_samples = std::max<std::size_t>(direct.light_samples(), 1);
        for (std::size_t light_sample = 1; light_sample <= light_samples; ++light_sample) {
            walkers.keep_if([&](Walker& w, std::uint32_t i) {
                const SurfaceSide side = scene.materials.side(w.x, w.wo);
                if (!side.bsdf) return false;
                const Vec3 wo = side.p.frame.to_local(w.wo);
                if (light_sample == 1) walkers.reads[i] = !ending.is_last(bounce) && reads(i, w, side, bounce);
                w.shadow_ray.value = Rgb(0.0);
                if (direct.light_samples() > 0)
                    choose_light_sample(direct, light_sample % light_samples, MaterialContinuation(), 1.0, side, wo, samplers[i],
                                        w);
                if (light_sample < light_samples) return true;
                w.leave(side, MaterialContinuation().sample(side, wo, samplers[i]));
                return true;
            });
            rays[q] += cast_shadow_rays(scene, T, direct, LeftOut(), bounce, walkers, observer,
                                        [&](std::uint32_t i, const Rgb& light) { find(i, q, light); });
        }
        walkers.keep_if([&](Walker& w, std::uint32_t i) {
            if (w.pdf != 0.0 && !is_black(w.beta) && ending.live(bounce, w, w.reflected, samplers[i])) return true;
            walkers.reads[i] = 0;
            return false;
        });

        // T follows the direction. The light that it hits, Le, is added.
        rays[q] += walkers.alive.size();
        walkers.follow(T, bounce, observer, [&](Walker& w, std::uint32_t i) {
            w.wo = -w.w;
            if ((direct.counts_what_is_hit() || w.pdf == delta_pdf) && emitters.is_emitter(w.x.shape)) {
                const Rgb emitted = emitters.emitted(w.x, w.wo);
                if (!is_black(emitted)) find(i, q, w.beta * emitted * direct.weight_of_hit(w.pdf, w.from, w.w, w.x));
            }
            return !walkers.reads[i] && !w.x.is_infinite();
        });
    }
}

}  // namespace neumann
