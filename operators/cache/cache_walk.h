// Walks that end where an irradiance cache is read: those from the camera, and the rays of the records themselves. A walk goes on
// from what is not diffuse, and from diffuse surfaces where no record stands nearby. At the first vertex x where one does, it asks
// for direct light as other walks do (ask_light.h) and reads
//
//     K^{k+1} Le (x, ωo) = ρ(x)/π E_k(x),   E_k = ∫ (T K^k Le) cosθ dω,   k ≥ 1
//
// so that a record of bounce k, read by a walk after b reflections, that at x among them, belongs to bounce b + k. The rays of
// records read records: E_k is made of direct light and of E_{k−1}, as K^i Le = K (K^{i−1} Le).
#pragma once

#include "core/base/hot.h"
#include "operators/walk/ask_light.h"
#include "operators/walk/continuation.h"
#include "operators/walk/observer.h"
#include "operators/walk/walk_settings.h"

#include <algorithm>
#include <span>
#include <vector>

namespace neumann {

struct CacheWalkers : Walkers {
    std::vector<char> reads;  // whether the walk ends with the direct light of this vertex
};

// ρ/π on a side, if light is read there.
inline std::optional<Rgb> diffuse_reflection(const SurfaceSide& side) {
    const auto* diffuse = std::get_if<Diffuse>(side.bsdf);
    return diffuse ? std::optional(diffuse->reflectance(side.p) * inv_pi) : std::nullopt;
}

// Walks on from first vertices. reads(i, walker, normal, weight, b), with the weight β ρ/π of the irradiance that is read at the
// walker's vertex, returns whether it was; find(i, q, light) adds to bounce q, or the rest, N + 1. Counts rays for each.
template <class Sampler, class Reads, class Find, class Observer = NoObserver>
NEUMANN_HOT void walk_to_records(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& settings,
                                 std::span<Sampler> samplers, CacheWalkers& walkers, std::span<std::uint64_t> rays,
                                 std::uint64_t& given_up, const Reads& reads, const Find& find, const Observer& observer = {}) {
    const Geometry& T = scene.geometry;
    const Emitters& emitters = scene.emitters;
    const Ending ending = settings.ending();
    const int N = settings.bounces;
    walkers.reads.assign(walkers.walker.size(), 0);
    for (int bounce = 1; ending.reach(bounce, walkers, samplers, given_up); ++bounce) {
        const auto q = static_cast<std::size_t>(std::min(bounce, N + 1));
        // R: read the cache, sample the lights and, along with the last light sample, the next direction.
        const std::size_t questions = std::max<std::size_t>(direct.questions(), 1);
        for (std::size_t question = 1; question <= questions; ++question) {
            walkers.keep_if([&](Walker& w, std::uint32_t i) {
                const SurfaceSide side = scene.materials.side(w.x, w.wo);
                if (!side.bsdf) return false;
                const Vec3 wo = side.p.frame.to_local(w.wo);
                if (question == 1 && !ending.is_last(bounce))
                    if (const auto reflection = diffuse_reflection(side))
                        walkers.reads[i] = reads(i, w, side.p.frame.n, w.beta * *reflection, bounce);
                w.asked.value = Rgb(0.0);
                if (direct.questions() > 0)
                    choose_question(direct, question % questions, MaterialContinuation(), 1.0, side, wo, samplers[i], w);
                if (question < questions) return true;
                const BsdfSample sampled = MaterialContinuation().sample(side, wo, samplers[i]);
                w.beta *= sampled.weight;
                w.reflected = max_component(sampled.weight);
                w.pdf = sampled.pdf;
                w.w = side.p.frame.to_world(sampled.wi);
                w.from = receiver(side);
                return true;
            });
            rays[q] += answer(scene, T, direct, LeftOut(), bounce, walkers, observer,
                              [&](std::uint32_t i, const Rgb& light) { find(i, q, light); });
        }
        walkers.keep_if([&](Walker& w, std::uint32_t i) {
            return w.pdf != 0.0 && !is_black(w.beta) && ending.live(bounce, w, w.reflected, samplers[i]);
        });

        // T: follow the direction; Le: add the light that it hits.
        rays[q] += walkers.alive.size();
        walkers.follow(T, bounce, observer, [&](Walker& w, std::uint32_t i) {
            w.wo = -w.w;
            if (emitters.is_emitter(w.x.shape)) {
                const Rgb emitted = emitters.emitted(w.x, w.wo);
                if (!is_black(emitted)) find(i, q, w.beta * emitted * direct.weight_of_hit(w.pdf, w.from, w.w, w.x));
            }
            return !walkers.reads[i] && !w.x.is_infinite();
        });
    }
}

}  // namespace neumann
