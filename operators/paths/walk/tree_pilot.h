// Measures by walks what a tree of paths needs (tree_numbers.h): pairs of walks that share their random numbers up to a depth and
// no further have the covariance Var(E[X | F_j]).
#pragma once

#include "core/scene/scene.h"
#include "operators/paths/walk/tree_numbers.h"
#include "operators/watch.h"

#include <cstdint>
#include <vector>

namespace neumann {

// Variances are sums over pixels and channels, of a single path; costs are rays.
struct TreePilot {
    std::vector<TreeMoments> bounces;  // of K^i Le, i = 0 … N
    TreeMoments sum;                   // of Σ K^i Le
    std::uint64_t rays = 0;            // cast for it
};

// Walks with light samples and directions by multiple importance sampling; `samples`: for each pixel, each with N + 1 partners.
TreePilot measure_tree(const Scene& scene, int bounces, std::uint32_t samples, std::uint64_t seed, const Watch& watch = {});

}  // namespace neumann
