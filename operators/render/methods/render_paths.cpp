// Renders by sampling paths: makes the method ready (prepare_paths.h), samples, and describes what was sampled (describe_paths.h).
#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/base/stopwatch.h"
#include "operators/render/methods/crew.h"
#include "operators/render/methods/describe_paths.h"
#include "operators/render/methods/prepare_paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace neumann {

namespace {

// Throws InputError if the moments of all pictures might not fit in memory, before the machine starts to swap.
void check_memory(const Goal& goal, const Film& film, int bounces, std::size_t quantities) {
    const double nodes = 7.0;  // upper bound: nodes of the tree of replicates, the result, and the samples' ranges
    const double bytes = nodes * film.crop_width * film.crop_height * static_cast<double>(quantities) *
                         PixelMoments::doubles_per_quantity * sizeof(double);
    // The size is known beforehand, so it may be a larger part of the memory than for data that grows as it goes.
    const double memory = goal.memory.value_or(0.8 * usable_memory());
    if (bytes > memory)
        throw InputError(
            fmt::format("{} bounces of {}×{} pixels need about {:.1f} GiB, and {:.1f} may be taken; take fewer bounces or a "
                        "smaller film",
                        bounces, film.crop_width, film.crop_height, bytes / 0x1p30, memory / 0x1p30));
}

// For --tail the pilot has chosen N; sample() renders again with a larger N if the rendered rest is still too large. It also
// renders again with larger replicates, if the time is enough for more of the small ones that a pilot chose than can be repeated.
struct Sampled {
    RenderedSeries series;
    SeriesReport report;
};
Sampled sample(const Method& method, SamplingSettings& settings, SamplingGoal goal, RestVerdict verdict, const RenderJob& job,
               double& setup_seconds) {
    std::optional<RenderedSeries> from;
    if (job.saving.from) from = std::move(job.saving.from->series);
    const bool goes_on = from.has_value();
    for (;;) {
        const int N = settings.walk.bounces;
        check_memory(job.goal, job.scene.film, N, settings.quantities());
        settings.walk.rest_probability = verdict != RestVerdict::measured ? 0.0
                                         : goes_on && N == job.saving.from->render.bounces
                                             ? job.saving.from->render.rest_probability
                                             : job.pilot().rest_probability(N);
        Watch watch = job.watch;
        watch.checkpoints = watch.checkpoints && !job.goal.only_pictures;
        const RecordedRender record{as_it_ran(method, settings, job.scene.film), job.goal.seed, N, settings.walk.rest_probability,
                                    settings.replicate_size};
        const auto keep = [&](const RenderedSeries& so_far, bool is_last) {
            RecordedRender as_sampled = record;
            as_sampled.replicate_size = so_far.replicate_size;  // smaller if it was stopped early
            job.saving.keep(as_sampled, job.choice, so_far, is_last);
            if (!job.saving.see || is_last || so_far.convergence.empty()) return;
            job.saving.see([&] {
                BounceSeries series =
                    as_series(so_far, report_series(job.scene, so_far, verdict), method, settings, goal.first, setup_seconds, job)
                        .series;
                describe(series, job);
                return series;
            });
        };
        const auto helpers = job.watch.crew ? job.watch.crew->begin(record, job.goal.colors) : nullptr;
        RenderedSeries series = render_series(job.scene, settings, goal, watch,
                                              {std::exchange(from, std::nullopt), keep, job.saving.longest_part}, helpers.get());
        const auto larger = goes_on || watch.stop() ? std::nullopt : series.larger_replicates;
        if (larger) {
            watch.tell(fmt::format("It is faster than in a pilot: once more with {} samples a pixel in a replicate, in place of {}",
                                   *larger, settings.replicate_size));
            *goal.seconds -= series.seconds;
            settings.replicate_size = *larger;
            continue;
        }
        SeriesReport report = report_series(job.scene, series, verdict);
        const double tail = job.goal.tail.value_or(0.0);
        if (!job.goal.tail || job.goal.bounces || watch.stop() || verdict != RestVerdict::measured ||
            report.tail_fraction() <= tail)
            return {std::move(series), std::move(report)};
        SamplingSettings with_more = settings;
        with_more.walk.bounces += std::max(1, N / 4);
        watch.tell(fmt::format("The rest is {:.3g} of the sum, more than {}: once more with {} bounces", report.tail_fraction(),
                               tail, with_more.walk.bounces));
        watch.chosen(with_more.walk.bounces);
        const Stopwatch clock;
        try {
            if (set_up(method, job, with_more)) setup_seconds += clock.seconds();
        } catch (const Stopped&) {
            series.outcome = Outcome::interrupted;
            return {std::move(series), std::move(report)};
        }
        settings = std::move(with_more);
    }
}

std::vector<std::pair<double, FurnaceWalk>> furnaces(const Roulette& roulette, double largest_albedo, int bounces) {
    std::vector<std::pair<double, FurnaceWalk>> all;
    for (const double albedo : {largest_albedo, 0.9, 0.99, 0.999})
        all.emplace_back(albedo, furnace_walk(roulette, albedo, bounces));
    return all;
}

}  // namespace

BounceSeries render_by_paths(const Method& requested, const RenderJob& job) {
    const Scene& scene = job.scene;
    const Goal& goal = job.goal;
    auto [method, settings, to_reach, setup_seconds] = prepare_paths(requested, job);
    const RestVerdict verdict = rest_verdict(*settings.method, job);
    auto [sampled, report] = sample(method, settings, to_reach, verdict, job, setup_seconds);
    auto [series, moments] = as_series(sampled, std::move(report), method, settings, to_reach.first, setup_seconds, job);
    if (const auto* both = std::get_if<method::Bidirectional>(&method); both && both->ways) {
        check_memory(goal, scene.film, *both->ways, 2 * (static_cast<std::size_t>(*both->ways) + 2));
        series.ways = render_ways(scene, settings, *both->ways, sampled.samples, {job.watch.stop, job.watch.progress});
    }
    auto& record = std::get<PathRecord>(series.record);
    if (settings.method->ends_by_roulette())
        record.furnaces =
            furnaces(settings.walk.roulette, max_component(scene.materials.largest_basic_albedo()), settings.walk.bounces);
    if (goal.only_pictures) {
        series.warnings.add("sample was not a finite number and was left out", sampled.tally.non_finite_samples());
    } else {
        settings.replicate_size = sampled.replicate_size;  // smaller if it was stopped early
        record.health = examine(scene, settings, sampled, *moments);
    }
    return std::move(series);
}

}  // namespace neumann
