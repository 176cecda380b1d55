// A walk that is a tree (tree_numbers.h): before its reflection at depth j it becomes ⌊r + u⌋ walks of 1/r of its weight each, u
// uniform in [0, 1). This is splitting where r = m_j/m_{j−1} > 1, and Russian roulette below.
#pragma once

#include "operators/paths/walk/first_vertices.h"
#include "operators/paths/walk/plain_walk.h"
#include "operators/paths/walk/term_samples.h"
#include "operators/paths/walk/tree_ratios.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace neumann {

// The walkers, and for each the path from the camera of which it is a branch.
struct TreeWalkers : PlainWalkers {
    std::vector<std::uint32_t> path;
    std::vector<double> light;        // of each path, if it branches by place (place_ratios.h)
    std::vector<int> splits_at = {};  // for pilots: the bounce before which each path splits into two or more, in any case
};

// Samples all terms along some camera rays. The numbers that the observer gets are those of walkers in `walkers`.
template <class Observer = NoObserver>
void walk_tree(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& settings, const TreeRatios& ratios,
               std::span<const CameraRay> rays, std::span<Sampler> samplers, TreeWalkers& walkers, TermSamples& out,
               const Observer& observer = {}) {
    const std::size_t quantities = static_cast<std::size_t>(settings.bounces) + 2;
    walkers.path.resize(rays.size());
    std::iota(walkers.path.begin(), walkers.path.end(), 0u);
    walkers.light.assign(rays.size(), 1.0);
    const auto find = [&](std::uint32_t i, std::size_t q, const Rgb& light) {
        out.quantities[walkers.path[i] * quantities + q] += light;
        observer.finds(i, q, light);
    };
    find_first_vertices(scene, scene.geometry, rays, walkers, out.rays[0], observer,
                        [&](std::uint32_t i, const Rgb& Le) { find(i, 0, Le); });

    const WalkNumbers of_paths{samplers, &walkers.path};
    std::vector<Walker> branches;
    std::vector<std::uint32_t> paths, parents;
    const auto branch = [&](int bounce) {
        if (!ratios.branches_at(bounce)) return;
        branches.clear();
        paths.clear();
        parents.clear();
        if (bounce == 1 && ratios.of_places)
            for (const std::uint32_t i : walkers.alive) walkers.light[i] = ratios.of_places->light(walkers.walker[i]);
        for (const std::uint32_t i : walkers.alive) {
            const Walker& w = walkers.walker[i];
            const std::uint32_t path = walkers.path[i];
            double r = ratios.at(bounce, w, walkers.light[path]);
            if (!walkers.splits_at.empty() && walkers.splits_at[path] == bounce) r = std::max(r, 2.0);
            const auto number = r == 1.0 ? 1 : static_cast<std::size_t>(std::floor(r + of_paths[i].next()));
            branches.insert(branches.end(), number, w);
            paths.insert(paths.end(), number, path);
            parents.insert(parents.end(), number, i);
            for (std::size_t k = branches.size() - number; k < branches.size(); ++k) branches[k].beta /= r;
        }
        walkers.walker.swap(branches);
        walkers.path.swap(paths);
        walkers.alive.resize(walkers.walker.size());
        std::iota(walkers.alive.begin(), walkers.alive.end(), 0u);
        observer.branches(bounce, std::span<const Walker>(walkers.walker), std::span<const std::uint32_t>(parents));
    };
    plain_walk(scene, direct, settings, of_paths, walkers, out.rays, out.given_up,
               {branch, [](std::uint32_t, const Walker&, const SurfaceSide&, int) { return false; }, find}, observer);
}

}  // namespace neumann
