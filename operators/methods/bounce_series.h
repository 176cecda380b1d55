// What every method returns and every consumer takes: for each bounce a picture, its errors and its cost, the partial sums, the
// rest, and what is to be known of how they were made.
#pragma once

#include "core/base/warnings.h"
#include "core/image/pixel_estimate.h"
#include "operators/methods/method.h"
#include "operators/methods/ways.h"
#include "operators/pictures/health.h"
#include "operators/pictures/missing_paths.h"
#include "operators/plan/plan.h"
#include "operators/walk/furnace_walk.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace neumann {

// Of a method that makes paths.
struct PathRecord {
    std::uint32_t replicate_size = 1;  // samples a pixel
    std::size_t replicates = 0;
    // Of a measured rest; without one, why there is none, in words.
    std::optional<double> rest_probability;
    std::string why_no_rest;
    std::uint64_t walks_given_up = 0;
    // How walks end in furnaces of the scene's largest albedo and of others near 1, by albedo; of `walk`.
    std::vector<std::pair<double, FurnaceWalk>> furnaces;
    std::optional<Health> health;  // unless only pictures were wanted
};

// Of a method with fields on patches.
struct FieldRecord {
    std::uint32_t replicates = 0;
    std::size_t patches = 0, unknowns = 0;
    std::uint64_t directions = 0;              // of all replicates
    std::optional<std::uint32_t> gather_rays;  // a sample
    std::string why;                           // it ended short of the goal, in words
    std::string why_no_rest;
    EnergyBalance power;
};

struct BounceSeries {
    std::function<PixelEstimate(std::size_t)> term, sum;  // K^i Le, and Σ_{k≤i} K^k Le; 0 … N
    std::optional<PixelEstimate> rest;                    // Σ_{k>N} K^k Le
    std::function<PixelEstimate()> limit;                 // Σ K^k Le, where there is a rest
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

    Method method;  // as it ran: with its options, the seed, and as many bounces and samples it is repeated
    std::uint64_t seed = 0;
    Plan plan;  // without parts where nothing was left out
    std::variant<PathRecord, FieldRecord> record;
    std::optional<Ways> ways;
    Warnings warnings;

    int bounces() const { return static_cast<int>(report.bounces.size()) - 1; }  // N
};

}  // namespace neumann
