// The asymptotic decay of the bounces: fits c · rⁱ to the mean of bounce i.
#pragma once

#include "operators/statistics/picture_statistics.h"

#include <optional>
#include <span>

namespace neumann {

struct DecayFit {
    double ratio = 0.0;               // r; it tends to the leading eigenvalue of K if there is a single one
    double log_at_0 = 0.0;            // log c
    std::size_t first = 0, last = 0;  // range of the fitted bounces
};

// Least squares in log mean over the second half of the bounces, with weights (mean / error)². Bounces that are zero or lost in
// noise (error above half the mean) are left out; bounces without error get the largest weight of the others. There is no fit with
// fewer than two bounces. The bounces of a render come from the same walks and are correlated, so the fit has no interval.
std::optional<DecayFit> fit_decay(std::span<const MeanWithError> bounces);

}  // namespace neumann
