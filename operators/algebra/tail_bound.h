#pragma once

#include "core/base/vec.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace neumann {

// An a-priori bound on the tail of the series: ‖Σ_{k>i} K^k Le‖∞ ≤ a^{i+1}/(1−a) ‖Le‖∞ for each channel, of which the
// largest is returned. T does not increase the sup norm, and R multiplies it by at most the largest albedo a (Arvo
// 1995). Infinite (no bound) if a ≥ 1 and there is light.
inline double tail_bound(const Rgb& largest_albedo, const Rgb& largest_radiance, int i) {
    double bound = 0.0;
    for (int c = 0; c < 3; ++c) {
        const double a = largest_albedo[c], radiance = largest_radiance[c];
        if (radiance == 0.0 || a == 0.0) continue;
        if (a >= 1.0) return std::numeric_limits<double>::infinity();
        bound = std::max(bound, std::pow(a, i + 1) / (1.0 - a) * radiance);
    }
    return bound;
}

}  // namespace neumann
