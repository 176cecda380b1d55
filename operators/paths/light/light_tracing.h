// Light tracing: every vertex of a path from a light is connected to the camera. It cannot make light that the camera
// sees in a mirror or through glass, nor the environment that the camera sees directly.
#pragma once

#include "core/base/hot.h"
#include "operators/paths/light/film_splats.h"

#include <algorithm>

namespace neumann {

struct LightTracingWork {
    LightWalkers walkers;
    std::vector<CameraEdge> edges;
};

// Traces a path for each sampler and calls splatted(path, position, quantity, value) with radiance times the number of
// pixels at a position on the film, for bounces 0 … N and the rest N + 1. Adds the number of rays to `rays`, which has
// N + 2 entries. Returns the number of walks given up.
template <class Transport, class Sampler, class OnSplat, class Observer = NoObserver>
NEUMANN_HOT std::uint64_t trace_light(const Scene& scene, const Transport& T, const EmissionSampler& emission, const Ending& ending,
                                      std::span<Sampler> samplers, LightTracingWork& work, const OnSplat& splatted,
                                      std::span<std::uint64_t> rays, const Observer& observer = {}) {
    const auto quantity = [&](int bounce) { return static_cast<std::size_t>(std::min(bounce, ending.bounces + 1)); };
    return walk_from_lights(
        scene, T, emission, ending, nullptr, samplers, work.walkers,
        [&](int j) {
            work.edges.clear();
            for (const std::uint32_t i : work.walkers.alive) {
                const LightWalker& w = work.walkers.walker[i];
                const CameraEdge edge = j == 0 ? emission_edge(scene, i, w.emission, samplers[i])
                                               : camera_edge(scene, i, w, place_on_lens(scene, samplers[i]));
                if (!is_black(edge.value)) work.edges.push_back(edge);
            }
            rays[quantity(j)] += work.edges.size();
            splat_what_is_seen(
                T, work.walkers, work.edges, j,
                [&](std::size_t k) {
                    const CameraEdge& edge = work.edges[k];
                    splatted(edge.walker, edge.position, quantity(j), edge.value);
                },
                observer);
        },
        [&](int j, std::size_t n) { rays[quantity(j)] += n; }, observer);
}

}  // namespace neumann
