// Where all methods meet: for each bounce a picture, its errors and its cost, the partial sums, and the rest.
#pragma once

#include "operators/pictures/missing_paths.h"

#include <functional>
#include <optional>
#include <vector>

namespace neumann {

struct BounceSeries {
    std::function<Estimate(std::size_t)> term, sum;  // K^i Le, and Σ_{k≤i} K^k Le; 0 … N
    std::optional<Estimate> rest;                    // Σ_{k>N} K^k Le
    SeriesReport report;
    Paths paths = Paths::all;
    std::vector<Checkpoint> convergence;
    Outcome outcome = Outcome::samples_reached;
    std::uint64_t samples = 0;  // a pixel
    std::uint64_t rays = 0;
    double seconds = 0.0;
    std::optional<double> setup_seconds = {};  // before them, where a method has a set-up of its own
    double degrees_of_freedom = 0.0;
};

}  // namespace neumann
