#include "operators/render/from_paths/rendered_series.h"

#include "core/base/error.h"
#include "core/base/stopwatch.h"
#include "operators/render/from_paths/bounded_samples.h"
#include "operators/render/from_paths/chance_agreement.h"
#include "operators/render/from_paths/shared_sampling.h"
#include "operators/statistics/joined_neighbours.h"
#include "operators/statistics/picture_statistics.h"

#include <fmt/format.h>
#include <algorithm>
#include <bit>
#include <numeric>
#include <thread>

namespace neumann {

namespace {

// In seconds. An interrupted render that has run for longer stops at once; otherwise it goes on to a number of samples
// that can be repeated, and to the end of its first replicate.
constexpr double patience = 3.0;
// The seconds after which a render with a time limit is cut off. Without its first replicate there would be no picture,
// so that one is given up late, and that of the walk, the plainest of methods, never.
double cut_off(double seconds, bool is_first) { return is_first ? 4.0 * seconds + 10.0 : 1.1 * seconds + 0.5; }

// The series before the first part.
RenderedSeries beginning(const PictureSampler& sampler, std::optional<RenderedSeries>& from) {
    const std::size_t Q = sampler.quantities();
    if (!from) return {SeriesMoments(sampler.width(), sampler.height(), Q, sampler.settings().pictures()), Tally(Q), {}};
    RenderedSeries series = std::move(*from);
    // An uncut render would not look at its errors where an earlier part ended, unless that is a power of two.
    std::erase_if(series.convergence, [](const Checkpoint& c) { return !std::has_single_bit(c.samples); });
    return series;
}

bool is_reached(double error, const Checkpoint& checkpoint) {
    return *std::max_element(checkpoint.term_error.begin(), checkpoint.term_error.end()) <= error;
}

}  // namespace

Checkpoint make_checkpoint(const RenderedSeries& series, const Watch& watch) {
    Checkpoint checkpoint;
    checkpoint.samples = series.samples;
    checkpoint.seconds = series.seconds;
    checkpoint.rays = std::accumulate(series.tally.rays.begin(), series.tally.rays.end(), std::uint64_t{0});
    const auto result = series.moments.result();
    const std::size_t terms = result.quantities() - 1;
    for (std::size_t i = 0; i < terms; ++i)
        checkpoint.term_error.push_back(relative_standard_error(
            without_chance_agreement(result.term(i), series.moments.ranges(), i, static_cast<double>(series.samples))));
    checkpoint.sum_error = relative_standard_error(result.sum(terms - 1));
    const auto term = [&](std::size_t i) { return result.term(i).mean; };
    if (watch.judge) watch.judge(term, result.sum(terms - 1).mean, checkpoint);
    if (watch.show) watch.show(terms - 1, [&](std::size_t i) { return joined_neighbours(result.term(i)); });
    return checkpoint;
}

std::uint32_t replicate_size(std::uint64_t samples) {
    const std::uint64_t most = samples / fewest_replicates;
    return static_cast<std::uint32_t>(std::bit_floor(std::clamp<std::uint64_t>(most, 1, largest_replicate)));
}

std::uint64_t in_whole_replicates(std::uint64_t samples) {
    const std::uint64_t size = replicate_size(samples);
    return (samples + size - 1) / size * size;
}

RenderedSeries render_series(const Scene& scene, const PictureSampler::Settings& settings, const SamplingGoal& goal,
                             const Watch& watch, Continuation continuation, Helpers* helpers) {
    const PictureSampler sampler(scene, settings);
    const std::uint64_t size = settings.replicate_size;
    if (continuation.from && continuation.from->merged.empty() && continuation.from->sizes != sampler.layout().sizes())
        throw std::logic_error("render_series: the pixels of what is there have other numbers of samples");
    RenderedSeries series = beginning(sampler, continuation.from);
    series.replicate_size = settings.replicate_size;
    series.sizes = sampler.layout().sizes();
    series.samples_are_bounded = samples_are_bounded(scene, settings);
    series.emission_is_seen = settings.method->starts_at_camera();
    series.rest_has_finite_variance = rest_has_finite_variance(scene, settings);
    const Stopwatch clock;
    const auto seconds_so_far = [&, before = series.seconds] { return before + clock.seconds(); };

    const auto report = [&](double replicates_done) {
        const double seconds = seconds_so_far();
        RenderProgress progress{settings.walk.bounces, series.samples, seconds, 0.0, std::nullopt};
        const double samples = replicates_done * static_cast<double>(size);
        if (goal.samples) progress.fraction = samples / static_cast<double>(*goal.samples);
        if (goal.seconds) progress.fraction = std::max(progress.fraction, seconds / *goal.seconds);
        if (progress.fraction > 0.0) progress.seconds_left = std::max(seconds / progress.fraction - seconds, 0.0);
        watch.progress(progress);
    };

    // Whether --spp with this number of samples gives at least this replicate size; a render that continues one with
    // smaller replicates may have more of them.
    const auto repeatable = [&](std::uint64_t done) { return replicate_size(done * size) >= size; };
    const bool may_outgrow = !goal.samples && series.samples == 0;
    const auto outgrown = [&](std::uint64_t done) { return may_outgrow && replicate_size((done + 1) * size) > size; };
    // The replicate size for the whole time, at the speed of the last block, if more time is left than has gone. Larger
    // replicates start from the beginning, so this is asked after each block, to lose little.
    double samples_a_second = 0.0;
    const auto larger_size = [&]() -> std::optional<std::uint32_t> {
        constexpr double caution = 0.8;
        const double seconds = seconds_so_far(), left = *goal.seconds - seconds;
        if (!may_outgrow || !(left > seconds)) return std::nullopt;
        const std::uint32_t larger = replicate_size(static_cast<std::uint64_t>(caution * left * samples_a_second));
        return larger > size ? std::optional(larger) : std::nullopt;
    };
    // A block is at most a sixteenth of the finished replicates: few nodes are kept, and dropping a block loses little.
    const auto block_after = [&](std::uint64_t done) {
        std::uint64_t block = std::bit_floor(std::max<std::uint64_t>(done / 16, 1));
        while ((goal.first + done) % block != 0) block /= 2;
        if (goal.samples)
            while (block > 1 && (done + block) * size > *goal.samples) block /= 2;
        const std::uint64_t there = series.samples / size;
        while (there > 0 && block > 1 &&
               static_cast<double>(block) * series.seconds > continuation.longest_part * static_cast<double>(there))
            block /= 2;
        return block;
    };
    std::optional<SharedSampling> shared;
    if (helpers)
        shared.emplace(sampler, *helpers, [&](std::uint64_t replicate) {
            const std::uint64_t done = replicate - goal.first;
            return goal.samples && done * size >= *goal.samples ? 0 : block_after(done);
        });
    std::vector<double> memory;
    bool error_reached = goal.relative_error && std::ranges::any_of(series.convergence, [&](const Checkpoint& checkpoint) {
                             return checkpoint.samples > size && is_reached(*goal.relative_error, checkpoint);
                         });
    for (std::uint64_t done = series.samples / size;;) {
        if (done > 0 && ((goal.samples && series.samples >= *goal.samples) || (error_reached && repeatable(done)))) {
            series.outcome = error_reached ? Outcome::error_reached : Outcome::samples_reached;
            break;
        }
        std::uint64_t block = block_after(done);
        if (goal.seconds && done > 0) {
            const double each = seconds_so_far() / static_cast<double>(done), left = *goal.seconds - seconds_so_far();
            while (block > 1 && static_cast<double>(block) * each > left) block /= 2;
            const bool is_late = seconds_so_far() > cut_off(*goal.seconds, false);
            series.larger_replicates = larger_size();
            if ((each > left && (repeatable(done) || is_late)) || series.larger_replicates || outgrown(done)) {
                series.outcome = Outcome::time_reached;
                break;
            }
        }

        const bool has_end = goal.seconds && (done > 0 || settings.method->first_may_be_late());
        const auto is_late = [&] { return has_end && seconds_so_far() > cut_off(*goal.seconds, done == 0); };
        Watch of_block;
        of_block.progress = [&](const RenderProgress& part) {
            report(static_cast<double>(done) + static_cast<double>(block) * part.fraction);
        };
        of_block.stop = [&] {
            const bool may_drop = seconds_so_far() > patience ? done > 0 || size > 1 : done > 0 && repeatable(done);
            return (may_drop && watch.stop()) || is_late();
        };
        auto node = shared ? shared->run(goal.first + done, block, series.tally, of_block, std::move(memory))
                           : sampler.run(goal.first + done, block, series.tally, of_block, std::move(memory));
        if (!node && done == 0 && !watch.stop())
            throw RunError(
                fmt::format("{} samples for each of {}×{} pixels were not finished in {:.3g} s: no picture was written; take "
                            "more time, a smaller film or walk",
                            size, sampler.width(), sampler.height(), seconds_so_far()));
        if (!node && done == 0) {
            PictureSampler::Settings single = settings;
            single.replicate_size = 1;
            return render_series(scene, single, goal, watch, {{}, continuation.keep, continuation.longest_part});
        }
        if (!node) {
            series.outcome = watch.stop() ? Outcome::interrupted : Outcome::time_reached;
            break;
        }
        memory = series.moments.add(std::move(*node));
        done += block;
        series.samples = done * size;
        samples_a_second = static_cast<double>(block * size) / (seconds_so_far() - series.seconds);
        series.seconds = seconds_so_far();

        const bool last = goal.samples && series.samples >= *goal.samples;
        const bool stop = watch.stop() && (repeatable(done) || series.seconds > patience);
        if (std::has_single_bit(series.samples) && !last && (watch.checkpoints || goal.relative_error)) {
            series.convergence.push_back(make_checkpoint(series, watch));
            if (goal.relative_error && done > 1 && is_reached(*goal.relative_error, series.convergence.back()))
                error_reached = true;
        }
        continuation.keep(series, false);
        if (last || stop || (error_reached && repeatable(done))) {
            series.outcome = last ? Outcome::samples_reached : stop ? Outcome::interrupted : Outcome::error_reached;
            break;
        }
    }
    if (series.convergence.empty() || series.convergence.back().samples != series.samples)
        series.convergence.push_back(make_checkpoint(series, watch));
    continuation.keep(series, true);
    return series;
}

}  // namespace neumann
