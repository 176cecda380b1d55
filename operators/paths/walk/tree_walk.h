// A walk that is a tree (tree_numbers.h): before its reflection at depth j it becomes ⌊r_j + u⌋ walks of 1/r_j of its weight each,
// u uniform in [0, 1). This is splitting where r_j = m_j/m_{j−1} > 1, and Russian roulette below.
#pragma once

#include "operators/paths/walk/first_vertices.h"
#include "operators/paths/walk/plain_walk.h"
#include "operators/paths/walk/term_samples.h"

#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace neumann {

// The walkers, and for each the path from the camera of which it is a branch.
struct TreeWalkers : PlainWalkers {
    std::vector<std::uint32_t> path;
};

// Samples all terms along some camera rays. ratios[j − 1] is r_j; deeper reflections neither split nor end the walk by
// it. The numbers that the observer gets are those of walkers in `walkers`.
template <class Observer = NoObserver>
void walk_tree(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& settings, std::span<const double> ratios,
               std::span<const CameraRay> rays, std::span<Sampler> samplers, TreeWalkers& walkers, TermSamples& out,
               const Observer& observer = {}) {
    const std::size_t quantities = static_cast<std::size_t>(settings.bounces) + 2;
    walkers.path.resize(rays.size());
    std::iota(walkers.path.begin(), walkers.path.end(), 0u);
    const auto find = [&](std::uint32_t i, std::size_t q, const Rgb& light) {
        out.quantities[walkers.path[i] * quantities + q] += light;
        observer.finds(i, q, light);
    };
    find_first_vertices(scene, scene.geometry, rays, walkers, out.rays[0], observer,
                        [&](std::uint32_t i, const Rgb& Le) { find(i, 0, Le); });

    const WalkNumbers of_paths{samplers, &walkers.path};
    std::vector<Walker> branches;
    std::vector<std::uint32_t> paths;
    const auto branch = [&](int bounce) {
        const double r = static_cast<std::size_t>(bounce) <= ratios.size() ? ratios[static_cast<std::size_t>(bounce) - 1] : 1.0;
        if (r == 1.0) return;
        branches.clear();
        paths.clear();
        for (const std::uint32_t i : walkers.alive) {
            const auto number = static_cast<std::size_t>(std::floor(r + of_paths[i].next()));
            branches.insert(branches.end(), number, walkers.walker[i]);
            paths.insert(paths.end(), number, walkers.path[i]);
        }
        for (Walker& w : branches) w.beta /= r;
        walkers.walker.swap(branches);
        walkers.path.swap(paths);
        walkers.alive.resize(walkers.walker.size());
        std::iota(walkers.alive.begin(), walkers.alive.end(), 0u);
    };
    plain_walk(scene, direct, settings, of_paths, walkers, out.rays, out.given_up,
               {branch, [](std::uint32_t, const Walker&, const SurfaceSide&, int) { return false; }, find}, observer);
}

}  // namespace neumann
