// The ratio of two quantities that have errors, with its interval: Fieller, Some Problems in Interval Estimation, 1954.
//
// For independent normal y and x and ρ = E y / E x, y − ρ x has the mean 0 and the variance σ_y² + ρ² σ_x². The
// interval holds all ρ ≥ 0 with
//
//     (y − ρ x)² ≤ t² (σ_y² + ρ² σ_x²)
//
// It has no upper end if x does not differ significantly from 0.
#pragma once

#include "operators/experiments/study/picture_errors.h"

namespace neumann {

struct RatioInterval {
    double ratio, low, high;
};

// y and x are not negative; t > 0 is a quantile of Student's distribution.
RatioInterval ratio_interval(const WithError& y, const WithError& x, double t);

}  // namespace neumann
