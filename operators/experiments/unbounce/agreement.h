// Compares the inverse with the forward series: Cⁿ L with Kⁿ Le of the same scene under all lights.
#pragma once

#include "operators/experiments/unbounce/unbounce.h"

#include <optional>
#include <vector>

namespace neumann {

struct TermAgreement {
    MeanWithError forward, difference;  // means over pixels and channels; difference: backward less forward
    double discretisation = 0.0;        // of the backward mean, as in Unbounced
    // √(Σ (b − f)² / Σ f²) over regions, weighted with their sizes, and channels; and its value from noise alone.
    double relative_difference = 0.0, by_noise = 0.0;
    // The part of the difference due to light by way of surfaces that are not seen; known for rendered scenes only.
    std::optional<MeanWithError> by_way_of_unseen = {};

    // The difference in units of its standard error, which includes the discretisation.
    double deviations() const;
};

// `forward`: bounces 1, 2, …; the terms that both have are compared. Throws InputError if the sizes differ.
std::vector<TermAgreement> agreement(const Unbounced& backward, const std::vector<Estimate>& forward,
                                     const std::vector<MeanWithError>& by_way_of_unseen = {});

}  // namespace neumann
