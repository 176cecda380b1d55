// The result of every method: for each bounce a picture with its errors and its cost, the partial sums, the rest, and a
// record of how they were made.
#pragma once

#include "core/base/warnings.h"
#include "core/image/pixel_estimate.h"
#include "operators/paths/walk/furnace_walk.h"
#include "operators/render/from_paths/rendered_series.h"
#include "operators/render/methods/method.h"
#include "operators/render/methods/method_choice.h"
#include "operators/render/methods/ways.h"
#include "operators/render/plan/plan.h"
#include "operators/render/report/health.h"
#include "operators/render/report/series_report.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace neumann {

// How a method that samples paths ran.
struct PathRecord {
    std::uint32_t replicate_size = 1;  // samples per pixel
    std::size_t replicates = 0;
    std::uint64_t first_replicate = 0;   // above 0 in a part of a render
    std::vector<SeedRange> merged = {};  // the seeds, if several were merged
    // The probability of going on into the rest, if the rest was measured; otherwise `why_no_rest` gives the reason in words.
    std::optional<double> rest_probability;
    std::string why_no_rest;
    std::uint64_t walks_given_up = 0;
    // For `walk`: pairs of an albedo and the cost and second moment of a walk in a furnace of that albedo, for the
    // scene's largest albedo and others near 1.
    std::vector<std::pair<double, FurnaceWalk>> furnaces;
    std::shared_ptr<const PathMethod> path_method;  // the method with what it prepared before the first sample
    // Samples of a pixel in a replicate, if pixels have different numbers.
    std::uint32_t fewest_of_pixel = 0, most_of_pixel = 0;
    std::vector<ChainStatistics> chains;  // for `metropolis`, bounces 0 … N
    std::optional<Health> health;         // none if only pictures were wanted
};

// How a method with fields on patches ran.
struct FieldRecord {
    std::uint32_t replicates = 0;
    std::size_t patches = 0, unknowns = 0;
    std::uint64_t directions = 0;              // rays per side of a patch, in all replicates together
    std::optional<std::uint32_t> gather_rays;  // per camera sample
    std::string why;                           // why it ended before the goal was reached, in words
    std::string why_no_rest;
    EnergyBalance power;
};

struct BounceSeries {
    std::function<PixelEstimate(std::size_t)> term, sum;  // K^i Le, and Σ_{k≤i} K^k Le; 0 … N
    std::optional<PixelEstimate> rest;                    // Σ_{k>N} K^k Le
    std::function<PixelEstimate()> limit;                 // Σ K^k Le, if there is a rest
    std::function<PictureMeans(std::size_t)> means_of_term, means_of_sum;
    std::optional<PictureMeans> means_of_rest;
    SeriesReport report;
    Paths paths = Paths::all;
    std::vector<Checkpoint> convergence;
    Outcome outcome = Outcome::samples_reached;
    std::uint64_t samples = 0;                // per pixel
    std::uint64_t rays = 0, shared_rays = 0;  // all rays, and the part of them for points that all pixels share
    double seconds = 0.0;
    double setup_seconds = 0.0;  // part of `seconds`: the time before the first sample
    double degrees_of_freedom = 0.0;

    Method method;                       // as it ran: the same method, seed, bounces and samples repeat the render
    std::optional<MethodChoice> choice;  // how --method auto chose it
    std::uint64_t seed = 0;
    Plan plan;  // has no parts if nothing was left out
    std::variant<PathRecord, FieldRecord> record;
    std::optional<Ways> ways;
    Warnings warnings;

    int bounces() const { return static_cast<int>(report.bounces.size()) - 1; }  // N
};

}  // namespace neumann
