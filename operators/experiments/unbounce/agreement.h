// The inverse beside the forward series: Cⁿ L against Kⁿ Le of the same scene under all lights.
#pragma once

#include "operators/experiments/unbounce/unbounce.h"

#include <optional>
#include <vector>

namespace neumann {

struct TermAgreement {
    MeanWithError forward, difference;  // of means over pixels and channels; difference: backward less forward
    double discretisation = 0.0;        // as Unbounced says of the backward mean
    // √(Σ (b − f)² / Σ f²) over regions, weighted with their sizes, and channels; the second is what noise alone makes of it.
    double relative_difference = 0.0, by_noise = 0.0;
    // Of the difference, what light makes that comes by way of surfaces that are not seen; known of rendered scenes alone.
    std::optional<MeanWithError> by_way_of_unseen = {};

    // The difference in its standard errors, the discretisation counted as one of them.
    double deviations() const;
};

// `forward`: bounces 1, 2, …; as many as both have are compared. Throws InputError if the sizes differ.
std::vector<TermAgreement> agreement(const Unbounced& backward, const std::vector<Estimate>& forward,
                                     const std::vector<MeanWithError>& by_way_of_unseen = {});

}  // namespace neumann
