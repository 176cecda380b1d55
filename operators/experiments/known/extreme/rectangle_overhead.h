#pragma once

#include "core/sampling/warp.h"

#include <cmath>

namespace neumann::known {

// The form factor from a point to a parallel rectangle a × b centred at height h above it.
inline double rectangle_overhead(double a, double b, double h) {
    const double A = 0.5 * a / h, B = 0.5 * b / h, p = std::sqrt(1.0 + A * A), q = std::sqrt(1.0 + B * B);
    return 2.0 / pi * (A / p * std::atan(B / p) + B / q * std::atan(A / q));
}

}  // namespace neumann::known
