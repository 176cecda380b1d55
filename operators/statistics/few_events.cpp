#include "operators/statistics/few_events.h"

#include <algorithm>
#include <cmath>

namespace neumann {

double expectation_above(double mean, double variance, double weight) {
    if (!(weight > 0.0)) return 0.0;
    const double m = mean + weight, v = variance + weight * weight;
    // Quantile of the gamma distribution of this mean and variance (Wilson and Hilferty 1931), within 1% if there is at
    // least one event.
    constexpr double normal_quantile = 1.959963984540054;
    const double ninth = v / (9.0 * m * m);
    return std::max(m * std::pow(1.0 - ninth + normal_quantile * std::sqrt(ninth), 3.0) - mean, 0.0);
}

}  // namespace neumann
