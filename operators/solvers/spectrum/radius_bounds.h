// Bounds on the spectral radius of a K ≥ 0 that keeps some light for good. Such a K has as many eigenvalues of the same modulus as
// there are closed loops of light, and a search from one start vector does not converge to them.
#pragma once

#include "operators/algebra/channel_operator.h"
#include "operators/watch.h"

namespace neumann {

struct RadiusBounds {
    double low = 0.0, high = 0.0;
    double applications = 0.0;
    bool meet() const { return high - low <= 1e-10 * high; }
};

// The number of applications after which it shows whether K ≥ 0 keeps some light for good.
constexpr double most_for_bounds = 1000.0;

// Upper bound: ρ(K) ≤ ‖K^n 1‖∞^(1/n), for every n. Lower bound: if y ≥ 0, y ≠ 0 and K y ≥ a y, then ρ(K) ≥ a (Collatz and
// Wielandt). y is 1 on the unknowns whose row sum of K^n is the largest; these exchange light only with each other once all other
// unknowns have lost some. Computed for n = 16, 32, 64 …, until the bounds meet, `most` applications are used up, or `watch` stops
// it.
RadiusBounds radius_bounds(const ChannelOperator& K, double most, const Watch& watch = {});

}  // namespace neumann
