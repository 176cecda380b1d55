// Renders a series until a goal is reached: the pictures of all bounces, their errors, and how the errors fell.
#pragma once

#include "operators/render/from_paths/picture_sampler.h"
#include "operators/watch.h"

#include <functional>
#include <limits>
#include <optional>

namespace neumann {

// Sampling stops at the first of these limits that it reaches; without any, it never stops.
struct SamplingGoal {
    std::optional<std::uint64_t> samples = {};  // per pixel
    std::optional<double> seconds = {};
    std::optional<double> relative_error = {};  // relative_standard_error() of every term that is not all zero; checked when the
                                                // number of samples is a power of two
    std::uint64_t first = 0;                    // first replicate; those before it are sampled elsewhere
};

// A range of replicates of a seed.
struct SeedRange {
    std::uint64_t seed = 0, first = 0, count = 0;
    // The pixels' numbers of samples in a replicate, if they differ; other seeds may have others.
    std::vector<std::uint32_t> sizes = {};
};

enum class Outcome { samples_reached, time_reached, error_reached, interrupted, memory_reached, does_not_pay };

struct RenderedSeries {
    SeriesMoments moments;
    Tally tally;
    std::vector<Checkpoint> convergence;
    Outcome outcome = Outcome::samples_reached;
    std::uint32_t replicate_size = 1;
    std::uint64_t samples = 0;
    // Set if the series ended because the remaining time is enough for replicates of this size, from the beginning.
    std::optional<std::uint32_t> larger_replicates = {};
    // The pixels' numbers of samples in a replicate, if they differ (sample_layout.h) and `merged` has none.
    std::vector<std::uint32_t> sizes = {};
    // If renders of several seeds were merged: their replicates, one range after the other. Otherwise empty.
    std::vector<SeedRange> merged = {};
    double seconds = 0.0;
    bool samples_are_bounded = false;  // of bounces 0 … N (bounded_samples.h)
    bool emission_is_seen = false;     // samples of bounce 0 are Le where camera rays end, which is bounded
    bool rest_has_finite_variance = false;
};

// The errors of the series so far.
Checkpoint make_checkpoint(const RenderedSeries& series, const Watch& watch);

// Divides a render into parts; another process can go on after each of them.
struct Continuation {
    std::optional<RenderedSeries> from = {};  // the series so far, of the same scene and settings
    // Called after every part with the series so far, and once more when the render ends.
    std::function<void(const RenderedSeries&, bool is_last)> keep = [](const RenderedSeries&, bool) {};
    double longest_part = std::numeric_limits<double>::infinity();  // seconds; but a part has at least one replicate
};

// The number of samples per pixel in one replicate: the largest power of two up to 32 that leaves at least 4
// replicates. Larger replicates have less error (stratification), but more replicates estimate it better: the 95%
// interval is ±12.7 standard errors with 2 replicates and ±3.2 with 4.
constexpr std::uint32_t largest_replicate = 32, fewest_replicates = 4;
std::uint32_t replicate_size(std::uint64_t samples);
// `samples`, or the next number that is a whole number of the replicates for it: smaller replicates, which divide any
// number, would have more error with as many samples than large ones with fewer.
std::uint64_t in_whole_replicates(std::uint64_t samples);

// Renders a series until the goal is reached. A render that is stopped by time or error ends at a number of samples from which
// replicate_size() gives the same replicate size again, and so does one that is interrupted, unless that would take long. If the
// time is enough for more replicates than that, because they are small, it ends before the time is up: larger replicates would be
// better (larger_replicates). One that continues another keeps its replicates, whatever their number. An interrupted render drops
// the samples that not all pixels have; if that is all of them, it renders one sample per pixel. The bits depend neither on how a
// render was divided nor on the helpers, and the seconds of the goal are those of all parts.
RenderedSeries render_series(const Scene& scene, const PictureSampler::Settings& settings, const SamplingGoal& goal,
                             const Watch& watch = {}, Continuation continuation = {}, Helpers* helpers = nullptr);

}  // namespace neumann
