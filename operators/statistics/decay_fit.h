// How fast the bounces fall in the end: the mean of bounce i as c · rⁱ.
#pragma once

#include "operators/statistics/picture_statistics.h"

#include <optional>
#include <span>

namespace neumann {

struct DecayFit {
    double ratio = 0.0;               // r; where one eigenvalue of K leads, it tends to that
    double log_at_0 = 0.0;            // log c
    std::size_t first = 0, last = 0;  // the bounces that it was fitted to
};

// Least squares in log mean, each bounce of the second half by its weight (mean / error)²; bounces that are zero or lost in noise
// (error above half the mean) are left out, and deterministic ones weigh as the most certain of the others. No fit with fewer than
// two bounces. The bounces of a render come from the same walks, so the fit has no interval.
std::optional<DecayFit> fit_decay(std::span<const MeanWithError> bounces);

}  // namespace neumann
