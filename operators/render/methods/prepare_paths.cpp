#include "operators/render/methods/prepare_paths.h"

#include "core/base/error.h"
#include "core/base/stopwatch.h"
#include "operators/render/methods/preparation.h"
#include "operators/render/methods/sampling.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

namespace neumann {

namespace {

// The time for sampling, in seconds, if the set-up has used up the limit.
constexpr double shortest_sampling = 1e-3;

// The time of a sample relative to that of a walk.
double walks_worth(const SamplingSettings& settings, const RenderJob& job) {
    const int N = settings.walk.bounces;
    const std::span<const double> rays = job.pilot().rays();
    return settings.method->walks_worth(N, rays.first(std::min(rays.size(), static_cast<std::size_t>(N) + 1)));
}

// The samples per pixel in one replicate: as many as still give several replicates.
std::uint32_t choose_replicate_size(const SamplingGoal& goal, const SamplingSettings& settings, const RenderJob& job) {
    if (job.saving.from) return job.saving.from->render.replicate_size;
    if (job.goal.replicates) return share_of_replicate(job.goal);
    if (goal.samples) return replicate_size(*goal.samples);  // these are whole replicates
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

SamplingGoal sampling_goal(const Goal& goal) {
    const Goal limits = with_default_limits(goal);
    SamplingGoal to_reach{limits.samples, limits.seconds, limits.relative_error};
    if (to_reach.samples && !goal.replicates) to_reach.samples = in_whole_replicates(*to_reach.samples);
    return to_reach;
}

// Restricts the goal to the replicates of one part.
void take_part(const PartOfSamples& part, std::uint64_t size, SamplingGoal& goal) {
    const std::uint64_t all = *goal.samples / size;
    if (all < part.n)
        throw OptionError(
            "part", fmt::format("{}/{}: {} samples a pixel are {} replicates of {}, which is fewer than one for each part", part.k,
                                part.n, *goal.samples, all, size));
    goal.first = all * (part.k - 1) / part.n;
    goal.samples = (all * part.k / part.n - goal.first) * size;
}

// A preparation without a time limit that takes more seconds than this is reported before it begins.
constexpr double long_preparation = 600.0;
// The number of samples a pixel that a film should have.
constexpr double enough_samples = 16.0;

// The time limit of the whole render in seconds, if it has one.
std::optional<double> time_limit(const Goal& goal) { return with_default_limits(goal).seconds; }

// The method as it is prepared in the available time. Reports a long preparation before it begins.
Method method_in_time(const Method& method, int bounces, const RenderJob& job) {
    if (job.goal.only_pictures || job.saving.from) return method;
    const std::optional<double> seconds = time_limit(job.goal);
    if (!seconds) {
        // A pilot is needed to know how long the rays take.
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

// The samples of a pixel that the goal allows, if each took as long as a walk; 0 if that is not known beforehand.
double expected_samples(int bounces, const RenderJob& job) {
    if (job.saving.from || job.goal.only_pictures) return 0.0;
    const Goal limits = with_default_limits(job.goal);
    if (limits.relative_error) return 0.0;
    if (limits.samples) return static_cast<double>(*limits.samples);
    const Film& film = job.scene.film;
    return std::max(limits.seconds.value_or(0.0) - job.seconds_gone(), 0.0) /
           (static_cast<double>(film.crop_width) * film.crop_height * job.pilot().seconds_per_walk(bounces));
}

}  // namespace

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

PreparedPaths prepare_paths(const Method& requested, const RenderJob& job) {
    const Goal& goal = job.goal;
    SamplingSettings settings = sampling_settings(requested, job.scene, job.plan, goal.seed);
    settings.colors = goal.colors;
    settings.walk.bounces = choose_bounces(job);
    Method method = method_in_time(requested, settings.walk.bounces, job);
    std::visit(
        [&]<class M>(M& m) {
            if constexpr (MakesPaths<M>) m.expect_samples(expected_samples(settings.walk.bounces, job), job.scene.film);
        },
        method);

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
                if constexpr (MakesPaths<M>) m.expect_room(job.scene.film, settings.replicate_size);
            },
            method);
    if (goal.part) take_part(*goal.part, settings.replicate_size, to_reach);
    if (to_reach.relative_error && !to_reach.samples && !to_reach.seconds) to_reach.seconds = longest_search;
    return {method, std::move(settings), to_reach, setup_seconds};
}

}  // namespace neumann
