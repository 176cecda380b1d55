// The ratios for walk_tree(): the best numbers for the depths of a scene or for its places, which a pilot measures, or equal ones.
#pragma once

#include "core/scene/scene.h"
#include "operators/paths/walk/place_ratios.h"
#include "operators/watch.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace neumann {

// The goal of a tree: the picture of a bounce, or the sum of all, by numbers for each depth or for each place; or, to compare, this
// number of branches at every reflection, as
// when distribution ray tracing casts equally many rays everywhere (Cook, Porter and Carpenter 1984).
struct TreeGoal {
    std::optional<int> bounce = {}, branches = {};
    bool by_place = false;
    bool operator==(const TreeGoal&) const = default;
};

// Choices are tried one by one (best_tree()), so that reflections deeper than this neither split nor end.
constexpr int most_depths_of_tree = 8;

struct TreeRatios {
    // m_j / m_{j−1} for j = 1 …, within 1/10 … 16, and with at most 256 branches, because the pilot may have missed something.
    std::vector<double> of_depths;
    std::uint64_t rays = 0;                     // cast by the pilot
    std::optional<PlaceRatios> of_places = {};  // in place of of_depths, and
    double rays_by_place = 0.0;                 // the rays of such a tree

    bool branches_at(int bounce) const { return of_places || of_depth(bounce) != 1.0; }
    // `light` is that of PlaceRatios.
    double at(int bounce, const Walker& w, double light) const {
        return of_places ? of_places->at(bounce, w, light) : of_depth(bounce);
    }
    // The cost of a tree in walks; `rays` as for walks_of_tree().
    double walks(std::span<const double> rays_of_walk) const;

private:
    double of_depth(int bounce) const {
        return static_cast<std::size_t>(bounce) <= of_depths.size() ? of_depths[static_cast<std::size_t>(bounce) - 1] : 1.0;
    }
};

// The ratios are the same for all seeds. Throws InputError if there is no such bounce or there are too many branches, and Stopped.
std::shared_ptr<const TreeRatios> tree_ratios(const Scene& scene, int bounces, const TreeGoal& goal, const Watch& watch = {});

}  // namespace neumann
