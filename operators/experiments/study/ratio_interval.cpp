#include "operators/experiments/study/ratio_interval.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace neumann {

RatioInterval ratio_interval(const WithError& y, const WithError& x, double t) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto squared = [](double v) { return v * v; };
    // a ρ² − 2 b ρ + c ≤ 0
    const double a = squared(x.value) - squared(t * x.standard_error), b = y.value * x.value,
                 c = squared(y.value) - squared(t * y.standard_error);
    const double root = b + std::sqrt(std::max(b * b - a * c, 0.0));
    RatioInterval result{x.value > 0.0 ? y.value / x.value : infinity, 0.0, infinity};
    if (c > 0.0) result.low = root > 0.0 ? c / root : infinity;
    if (a > 0.0) result.high = root / a;
    return result;
}

}  // namespace neumann
