// Renders a series until a goal is reached: the pictures of all bounces, their errors, and how the errors fell.
#pragma once

#include "operators/pictures/picture_sampler.h"
#include "operators/pictures/watch.h"

#include <optional>

namespace neumann {

// When to stop sampling; what is given holds together, whichever comes first. Nothing given: never.
struct SamplingGoal {
    std::optional<std::uint64_t> samples;  // a pixel
    std::optional<double> seconds;
    std::optional<double> relative_error;  // of every term that is not all zero, as relative_standard_error(); looked at when the
                                           // number of samples is a power of two
};

enum class Outcome { samples_reached, time_reached, error_reached, interrupted, memory_reached, does_not_pay };

struct RenderedSeries {
    SeriesMoments moments;
    Tally tally;
    std::vector<Checkpoint> convergence;
    Outcome outcome = Outcome::samples_reached;
    std::uint32_t replicate_size = 1;
    std::uint64_t samples = 0;
    double seconds = 0.0;
    bool samples_are_bounded = false;  // of bounces 0 … N, as bounded_samples.h knows it
};

// Samples a pixel in one replicate: the largest power of two up to 32 that divides the samples into at least 4 replicates. Large
// replicates have less error, many tell it better: of 2, a 95% interval is 12.7 standard errors to each side, of 4 it is 3.2.
constexpr std::uint32_t largest_replicate = 32, fewest_replicates = 4;
std::uint32_t replicate_size(std::uint64_t samples);

// A render that is stopped by time or error ends at a number of samples from which replicate_size() finds the same replicates
// again, and so does one that is interrupted, unless that would take long. An interrupted one drops the samples that are not yet in
// all pixels; where that is all of them it takes a single one.
RenderedSeries render_series(const Scene& scene, const PictureSampler::Settings& settings, const SamplingGoal& goal,
                             const Watch& watch = {});

}  // namespace neumann
