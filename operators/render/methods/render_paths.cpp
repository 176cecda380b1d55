// Renders by sampling paths.
#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/base/stopwatch.h"
#include "operators/render/from_paths/mixed_sampler.h"
#include "operators/render/methods/crew.h"
#include "operators/render/methods/path_bias.h"
#include "operators/render/methods/path_warnings.h"
#include "operators/render/methods/preparation.h"
#include "operators/render/methods/render_job.h"
#include "operators/render/methods/sampling.h"
#include "operators/render/report/least_errors.h"
#include "operators/render/report/missing_paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

namespace neumann {

namespace {

// The time for sampling, in seconds, if the set-up has used up the limit.
constexpr double shortest_sampling = 1e-3;

// The time of a sample beside that of a walk: by its rays, or as measured, the largest in boxes and on a mesh of 10,000 triangles
// in a room, of two processors.
double walks_worth(const SamplingSettings& settings, const RenderJob& job) {
    const int N = settings.walk.bounces;
    const std::span<const double> rays = job.pilot().rays();
    return settings.method->walks_worth(N, rays.first(std::min(rays.size(), static_cast<std::size_t>(N) + 1)));
}

// Samples per pixel in one replicate: as many as still give several replicates.
std::uint32_t choose_replicate_size(const SamplingGoal& goal, const SamplingSettings& settings, const RenderJob& job) {
    if (job.saving.from) return job.saving.from->render.replicate_size;
    if (job.goal.replicates) return share_of_replicate(job.goal);
    if (goal.samples) return replicate_size(*goal.samples);  // which are whole replicates
    if (!goal.seconds) return largest_replicate;
    const Film& film = job.scene.film;
    const Split& split = settings.walk.split;
    const double pixels = static_cast<double>(film.crop_width) * film.crop_height,
                 seconds = job.pilot().seconds_per_walk(settings.walk.bounces) * std::max(split.lights, split.walks) *
                           walks_worth(settings, job),
                 affordable = *goal.seconds / (pixels * seconds);
    return std::bit_floor(
        static_cast<std::uint32_t>(std::clamp(affordable / fewest_replicates, 1.0, static_cast<double>(largest_replicate))));
}

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

std::vector<std::pair<double, FurnaceWalk>> furnaces(const Roulette& roulette, double largest_albedo, int bounces) {
    std::vector<std::pair<double, FurnaceWalk>> all;
    for (const double albedo : {largest_albedo, 0.9, 0.99, 0.999})
        all.emplace_back(albedo, furnace_walk(roulette, albedo, bounces));
    return all;
}

SamplingGoal sampling_goal(const Goal& goal) {
    const Goal limits = with_default_limits(goal);
    SamplingGoal to_reach{limits.samples, limits.seconds, limits.relative_error};
    if (to_reach.samples && !goal.replicates) to_reach.samples = in_whole_replicates(*to_reach.samples);
    return to_reach;
}

// The replicates of a part, and of no other.
void take_part(const PartOfSamples& part, std::uint64_t size, SamplingGoal& goal) {
    const std::uint64_t all = *goal.samples / size;
    if (all < part.n)
        throw OptionError(
            "part", fmt::format("{}/{}: {} samples a pixel are {} replicates of {}, which is fewer than one for each part", part.k,
                                part.n, *goal.samples, all, size));
    goal.first = all * (part.k - 1) / part.n;
    goal.samples = (all * part.k / part.n - goal.first) * size;
}

RestVerdict rest_verdict(const PathMethod& method, const RenderJob& job) {
    if (!method.has_rest() || job.goal.only_pictures) return RestVerdict::not_sampled;
    return job.pilot().converges() ? RestVerdict::measured : RestVerdict::not_converging;
}

BounceSeries bounce_series(const RenderedSeries& series, const std::shared_ptr<const SeriesMoments::Result>& result,
                           const std::shared_ptr<const LeastErrors>& least, const std::optional<TwoRadii>& radii,
                           SeriesReport report) {
    BounceSeries out;
    out.term = [result, least, radii](std::size_t i) {
        PixelEstimate term = with_bias(
            result->term(i), [&] { return result->difference_of_term(i); }, radii, *result);
        if (least) term.least_error = least->of_term(i);
        return term;
    };
    out.sum = [result, least, radii](std::size_t i) {
        PixelEstimate sum = with_bias(
            result->sum(i), [&] { return result->difference_of_sum(i); }, radii, *result);
        if (least) sum.least_error = least->of_sum(i);
        return sum;
    };
    out.means_of_term = [result](std::size_t i) { return result->means_of_term(i); };
    out.means_of_sum = [result](std::size_t i) { return result->means_of_sum(i); };
    if (report.rest_verdict == RestVerdict::measured) {
        out.rest = out.term(result->quantities() - 1);
        out.means_of_rest = result->means_of_term(result->quantities() - 1);
        out.limit = [sum = out.sum, last = result->quantities() - 1] { return sum(last); };
    }
    out.report = std::move(report);
    out.convergence = series.convergence;
    out.outcome = series.outcome;
    out.samples = series.samples;
    out.rays = std::accumulate(series.tally.rays.begin(), series.tally.rays.end(), std::uint64_t{0});
    out.shared_rays = series.tally.shared_rays;
    out.seconds = series.seconds;
    out.degrees_of_freedom = result->degrees_of_freedom();
    return out;
}

// The method with the options that had been left open.
Method as_it_ran(Method method, const SamplingSettings& settings, const Film& film) {
    const bool is_mixed = as<MixedPaths>(settings.method) != nullptr;
    if (const auto* mixed = std::get_if<method::Mixed>(&method); mixed && !is_mixed) {  // its pilot was interrupted
        method::Walk walk{*mixed};
        walk.sampler = settings.sampler;
        return walk;
    }
    std::visit(
        [&]<class M>(M& m) {
            if constexpr (MakesPaths<M>) {
                m.sampler = settings.sampler;
                m.complete(settings, film);
            }
            if constexpr (requires { m.adaptive; })
                if (!settings.allocation && !is_mixed) m.adaptive = {};  // its pilot was interrupted
        },
        method);
    return method;
}

bool set_up(const Method& method, const RenderJob& job, SamplingSettings& settings) {
    const Stopwatch clock;
    const std::optional<double> seconds = job.goal.only_pictures ? std::nullopt : with_default_limits(job.goal).seconds;
    const auto is_late = [&] { return seconds && clock.seconds() > cut_off_preparation(*seconds); };
    Watch watch = job.watch;
    watch.stop = [&] { return job.watch.stop() || is_late(); };
    try {
        return set_up(method, job.scene, settings.walk.bounces, job.goal.memory.value_or(default_memory()), settings, job.prepared,
                      watch);
    } catch (const Stopped&) {
        if (!job.watch.stop())
            throw RunError(
                fmt::format("{} was not ready after {:.3g} s of {:.3g}: no picture was written; take more time, a "
                            "number of samples, or walk",
                            name_of(method), clock.seconds(), *seconds));
        throw Stopped(
            fmt::format("interrupted while {} was made ready, before the first sample: no picture was written", name_of(method)));
    }
}

// A series of paths, and the moments that its pictures refer to.
struct AsSeries {
    BounceSeries series;
    std::shared_ptr<const SeriesMoments::Result> moments;
};

// Adds what was done before the first sample.
void add_setup(BounceSeries& series, const SamplingSettings& settings, double setup_seconds) {
    if (setup_seconds == 0.0) return;
    series.setup_seconds = setup_seconds;
    series.seconds += setup_seconds;
    series.rays += settings.method->rays();
    if (settings.allocation) series.rays += settings.allocation->rays;
    for (Checkpoint& checkpoint : series.convergence) checkpoint.seconds += setup_seconds;
}

PathRecord record_of(const RenderedSeries& sampled, const Method& method, const SamplingSettings& settings, RestVerdict verdict,
                     std::uint64_t first, const RenderJob& job) {
    PathRecord record;
    record.replicate_size = sampled.replicate_size;
    record.replicates = sampled.moments.replicates();
    record.first_replicate = first;
    record.merged = sampled.merged;
    record.walks_given_up = sampled.tally.given_up;
    if (verdict == RestVerdict::measured) record.rest_probability = settings.walk.rest_probability;
    if (verdict == RestVerdict::not_converging)
        record.why_no_rest = fmt::format("{} of {} walks had not ended after {} bounces and were given up", job.pilot().given_up(),
                                         job.pilot().walks(), job.pilot().bounces() + Pilot::give_up);
    if (!prepares_fields(method)) record.path_method = settings.method;  // fields are large, and nothing is told of them
    record.chains = sampled.tally.chains;
    if (settings.allocation) {
        SamplingSettings as_sampled = settings;
        as_sampled.replicate_size = sampled.replicate_size;
        const SampleLayout layout = as_sampled.layout(job.scene.film);
        record.fewest_of_pixel = layout.size(0);
        for (std::uint32_t pixel = 0; pixel < layout.pixels(); ++pixel) {
            record.fewest_of_pixel = std::min(record.fewest_of_pixel, layout.size(pixel));
            record.most_of_pixel = std::max(record.most_of_pixel, layout.size(pixel));
        }
    }
    return record;
}

// What was sampled, as a series, but for its health.
AsSeries as_series(const RenderedSeries& sampled, SeriesReport report, const Method& method, const SamplingSettings& settings,
                   std::uint64_t first, double setup_seconds, const RenderJob& job) {
    const Paths paths = settings.method->paths(job.scene);
    if (paths != Paths::all) report_missing(report, job.pilot());
    const auto moments = std::make_shared<const SeriesMoments::Result>(sampled.moments.result());
    std::shared_ptr<const LeastErrors> least;
    if (!job.goal.only_pictures) {
        least = std::make_shared<const LeastErrors>(job.scene, settings, sampled, *moments);
        report_least(report, *least);
    }
    const RestVerdict verdict = report.rest_verdict;
    BounceSeries series = bounce_series(sampled, moments, least, settings.method->two_radii(), std::move(report));
    report_bias(job.scene.film, *moments, *settings.method, series);
    series.paths = paths;
    series.method = as_it_ran(method, settings, job.scene.film);
    series.record = record_of(sampled, method, settings, verdict, first, job);
    warn_of_paths(series, job, settings, sampled, max_component(job.scene.materials.largest_basic_albedo()));
    add_setup(series, settings, setup_seconds);
    return {std::move(series), moments};
}

// For --tail the pilot has chosen N. If the rendered rest is still too large, sample() renders again with a larger N; and with
// larger replicates, if the time is enough for more of the small ones that a pilot chose than can be repeated.
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
            as_sampled.replicate_size = so_far.replicate_size;  // smaller where it was stopped early
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

// Seconds from which a preparation without a time limit is told of before it begins.
constexpr double long_preparation = 600.0;
// Samples a pixel that a film should have.
constexpr double enough_samples = 16.0;

// The seconds of the whole render, if it has a limit.
std::optional<double> time_limit(const Goal& goal) { return with_default_limits(goal).seconds; }

// The method as it is prepared in the time that there is. Tells what takes long before it begins.
Method foretold(const Method& method, int bounces, const RenderJob& job) {
    if (job.goal.only_pictures || job.saving.from) return method;
    const std::optional<double> seconds = time_limit(job.goal);
    if (!seconds) {
        // What a method prepares for is known without a pilot, but not how long its rays take.
        if (!prepares_fields(method)) return method;
        const Preparation preparation = Preparations(job.scene, job.pilot()).of(method);
        if (preparation.seconds > long_preparation)
            job.watch.tell(fmt::format("Before the first sample, {}", describe(preparation)));
        return method;
    }
    const Film& film = job.scene.film;
    const double each = static_cast<double>(film.crop_width) * film.crop_height * job.pilot().seconds_per_walk(bounces),
                 left = std::max(*seconds - job.seconds_gone(), 0.0);
    if (left < fewest_replicates * each) {
        const double smaller = std::sqrt(left / (enough_samples * each));
        job.watch.tell(fmt::format(
            "One sample a pixel takes about {:.2g} s on a film of {}×{}, and {:.3g} s are left; {:.0f} samples take {:.0f} s, or a "
            "film of {:.0f}×{:.0f}",
            each, film.crop_width, film.crop_height, left, enough_samples, std::ceil(enough_samples * each),
            std::max(std::floor(smaller * film.crop_width), 1.0), std::max(std::floor(smaller * film.crop_height), 1.0)));
    }
    const Preparations preparations(job.scene, job.pilot());
    const Method fits = preparations.in_time(*seconds, method);
    if (const Preparation whole = preparations.of(method), made = preparations.of(fits); made.rays < whole.rays)
        job.watch.tell(fmt::format("{} is made smaller, of {:.0f} patches and {:.2g} rays: {}", name_of(method), made.facets,
                                   made.rays, describe(whole)));
    return fits;
}

}  // namespace

BounceSeries render_by_paths(const Method& asked, const RenderJob& job) {
    const Scene& scene = job.scene;
    const Goal& goal = job.goal;
    SamplingSettings settings = sampling_settings(asked, scene, job.plan, goal.seed);
    settings.colors = goal.colors;
    settings.walk.bounces = choose_bounces(job);
    const Method method = foretold(asked, settings.walk.bounces, job);

    SamplingGoal to_reach = sampling_goal(goal);
    if (goal.samples && *goal.samples != *to_reach.samples)
        job.watch.tell(
            fmt::format("{} samples a pixel in place of {}: whole replicates of {}, which have less error than smaller ones",
                        *to_reach.samples, *goal.samples, replicate_size(*to_reach.samples)));
    double setup_seconds = job.choice ? job.choice->seconds : 0.0;
    const Stopwatch clock;
    if (set_up(method, job, settings)) setup_seconds += clock.seconds();
    if (to_reach.seconds) to_reach.seconds = std::max(*to_reach.seconds - job.seconds_gone(), shortest_sampling);
    settings.replicate_size = choose_replicate_size(to_reach, settings, job);
    if (!job.saving.from)
        std::visit(
            [&]<class M>(const M& m) {
                if constexpr (MakesPaths<M>) m.expect_room(scene.film, settings.replicate_size);
            },
            method);
    if (goal.part) take_part(*goal.part, settings.replicate_size, to_reach);
    if (to_reach.relative_error && !to_reach.samples && !to_reach.seconds) to_reach.seconds = longest_search;

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
        settings.replicate_size = sampled.replicate_size;  // smaller where it was stopped early
        record.health = examine(scene, settings, sampled, *moments);
    }
    return std::move(series);
}

}  // namespace neumann
