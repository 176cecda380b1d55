// Measures the moments of a tree of paths (tree_numbers.h) with walks: pairs of walks that share their random numbers
// only up to depth j have the covariance Var(E[X | F_j]).
#pragma once

#include "core/scene/scene.h"
#include "operators/paths/walk/tree_numbers.h"
#include "operators/watch.h"

#include <cstdint>
#include <vector>

namespace neumann {

// Variances are sums over pixels and channels, of a single path; costs are rays.
struct TreePilot {
    std::vector<TreeMoments> bounces;  // moments of K^i Le, i = 0 … N
    TreeMoments sum;                   // moments of Σ K^i Le
    std::uint64_t rays = 0;            // number of rays cast for the measurement
};

// Uses walks with light samples and directions by multiple importance sampling. `samples` is their number for each
// pixel; each has N + 1 partners.
TreePilot measure_tree(const Scene& scene, int bounces, std::uint32_t samples, std::uint64_t seed, const Watch& watch = {});

}  // namespace neumann
