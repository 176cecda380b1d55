// Renders a series until a goal is reached: the pictures of all bounces, their errors, and how the errors fell.
#pragma once

#include "operators/pictures/picture_sampler.h"

#include <functional>
#include <optional>
#include <string>

namespace neumann {

// When to stop sampling; what is given holds together, whichever comes first. Nothing given: never.
struct SamplingGoal {
    std::optional<std::uint64_t> samples;  // a pixel
    std::optional<double> seconds;
    std::optional<double> relative_error;  // of every term that is not all zero, as relative_standard_error(); looked at when the
                                           // number of samples is a power of two
};

// The error at one number of samples.
struct Checkpoint {
    std::uint64_t samples = 0, rays = 0;
    double seconds = 0.0;
    std::vector<double> term_error;       // relative standard error of each term 0 … N
    double sum_error = 0.0;               // and of Σ_{k≤N}
    std::vector<double> true_term_error;  // relative error against a reference, if there is one
    std::optional<double> true_sum_error;
};

enum class Outcome { samples_reached, time_reached, error_reached, interrupted, memory_reached, does_not_pay };

struct RenderProgress {
    std::uint64_t samples;  // a pixel, finished
    double seconds;         // so far
    double fraction;        // of the goal, as far as known; 0 … 1
    std::optional<double> seconds_left;
};

// What the loop tells and asks while it works; it prints nothing itself.
struct RenderObserver {
    std::function<void(const RenderProgress&)> progress = [](const RenderProgress&) {};  // from time to time, from any thread
    std::function<bool()> interrupted = [] { return false; };
    bool checkpoints = true;  // before the last one: they take time of their own
    // Fills in the true errors of a checkpoint, given the series so far.
    std::function<void(const SeriesMoments::Result&, Checkpoint&)> judge = [](const SeriesMoments::Result&, Checkpoint&) {};
};

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
                             const RenderObserver& observer = {});

}  // namespace neumann
