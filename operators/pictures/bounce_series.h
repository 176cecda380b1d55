// Where all methods meet: for each bounce a picture, its errors and its cost, the partial sums, and the rest.
#pragma once

#include "core/image/pixel_estimate.h"
#include "operators/pictures/missing_paths.h"

#include <functional>
#include <optional>
#include <vector>

namespace neumann {

struct BounceSeries {
    std::function<PixelEstimate(std::size_t)> term, sum;  // K^i Le, and Σ_{k≤i} K^k Le; 0 … N
    std::optional<PixelEstimate> rest;                    // Σ_{k>N} K^k Le
    std::function<PictureMeans(std::size_t)> means_of_term, means_of_sum;
    std::optional<PictureMeans> means_of_rest;
    SeriesReport report;
    Paths paths = Paths::all;
    std::vector<Checkpoint> convergence;
    Outcome outcome = Outcome::samples_reached;
    std::uint64_t samples = 0;  // a pixel
    std::uint64_t rays = 0;
    double seconds = 0.0;
    double setup_seconds = 0.0;  // of these, before the first sample
    double degrees_of_freedom = 0.0;
};

}  // namespace neumann
