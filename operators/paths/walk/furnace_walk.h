// The cost and variance of Russian roulette in a furnace, where both are known: everything emits radiance 1 and has
// albedo ρ. A walk that survives with probability q, with its weight divided by q, has 1/(1 − q) vertices on average;
// its sum S of all terms has
//
//     E[S] = 1/(1 − ρ),   E[S²] = (1 + ρ) / ((1 − ρ) (1 − ρ²/q)),   infinite for ρ² ≥ q
//
// For roulette by albedo or by throughput, q = ρ. Without roulette no walk ends before bounce N, and q = ρ beyond.
#pragma once

#include "operators/paths/walk/roulette.h"

#include <cmath>
#include <limits>

namespace neumann {

struct FurnaceWalk {
    double vertices;       // expected number, including the first vertex
    double second_moment;  // E[S²]
};

inline FurnaceWalk furnace_walk(const Roulette& roulette, double albedo, int bounces) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const bool goes_on = roulette.kind == Roulette::Kind::none;
    const double q = roulette.kind == Roulette::Kind::fixed ? roulette.survival : albedo;
    const double vertices = q < 1.0 ? (goes_on ? bounces : 0.0) + 1.0 / (1.0 - q) : infinity;
    if (albedo * albedo >= q || albedo >= 1.0) return {vertices, albedo == 0.0 ? 1.0 : infinity};
    if (!goes_on) return {vertices, (1.0 + albedo) / ((1.0 - albedo) * (1.0 - albedo * albedo / q))};
    // S = Σ_{k≤N} ρ^k + ρ^N Y, where Y is the number of vertices beyond bounce N.
    const double last = std::pow(albedo, bounces), sum = (1.0 - last * albedo) / (1.0 - albedo), mean = albedo / (1.0 - albedo);
    return {vertices, sum * sum + 2.0 * sum * last * mean + last * last * mean * (1.0 + albedo) / (1.0 - albedo)};
}

}  // namespace neumann
