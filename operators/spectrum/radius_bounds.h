// Between which bounds the spectral radius of K ≥ 0 lies, where K keeps some light for good: eigenvalues are then as many as there
// are ways to go round, all of one modulus, and no search from one start settles on them.
#pragma once

#include "operators/solvers/channel_operator.h"
#include "operators/watch.h"

namespace neumann {

struct RadiusBounds {
    double low = 0.0, high = 0.0;
    double applications = 0.0;
    bool meet() const { return high - low <= 1e-10 * high; }
};

// So many applications show whether K ≥ 0 keeps some light for good.
constexpr double most_for_bounds = 1000.0;

// ρ(K) ≤ ‖K^n 1‖∞^(1/n), for every n. And where y ≥ 0 is not 0 and K y ≥ a y, ρ(K) ≥ a (Collatz and Wielandt): y is 1 on the
// unknowns whose row of K^n is as large as the largest, which are closed among themselves once all others have lost some.
// n = 16, 32, 64 …, until they meet or there have been `most` applications; fewer where `watch` stops it.
RadiusBounds radius_bounds(const ChannelOperator& K, double most, const Watch& watch = {});

}  // namespace neumann
