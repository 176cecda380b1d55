#include "operators/render/from_fields/field_goal.h"

#include "core/base/error.h"
#include "core/base/stopwatch.h"
#include "operators/render/from_fields/field_costs.h"
#include "operators/render/from_fields/field_errors.h"
#include "operators/render/from_fields/field_rendering.h"
#include "operators/statistics/joined_neighbours.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace neumann {

namespace {

constexpr std::size_t fewest_patches = 500, most_patches = 250'000;
constexpr std::uint32_t fewest_rays = 16, most_rays = 1 << 16, most_samples = 1024, most_light_samples = 64;
constexpr std::uint32_t pilot_samples = 4;
// A step multiplies no part by more than this: estimates from few samples are rough.
constexpr double most_growth = 8.0;
constexpr double without_limit = 1e6;
// Renders take up to this many times their predicted time and memory.
constexpr double caution = 1.2;
// If the error is out of reach, a step pays if the error falls at least like (total time)^−least_slope; the error of
// sampling falls like the power −1/2.
constexpr double least_slope = 1.0 / 8.0;
// Without an error to reach, a step pays if the error falls by this part.
constexpr double least_gain = 0.05;
constexpr int shorter_steps = 8;

FieldSettings largest(FieldSettings settings) {
    settings.patching.patches = most_patches;
    settings.rays = most_rays;
    settings.light_samples = most_light_samples;
    settings.samples = most_samples;
    return settings;
}

bool same(const FieldSettings& a, const FieldSettings& b) {
    return a.patching.patches == b.patching.patches && a.rays == b.rays && a.light_samples == b.light_samples &&
           a.samples == b.samples;
}

FieldRun make_run(const Film& film, FieldPictures pictures, const FieldSettings& settings, std::vector<Checkpoint> before,
                  double seconds) {
    FieldRun run{std::move(pictures), settings, std::move(before), {}};
    run.seconds = seconds;
    Checkpoint checkpoint;
    checkpoint.samples = run.pictures.samples;
    checkpoint.rays = std::accumulate(run.pictures.rays.begin(), run.pictures.rays.end(), std::uint64_t{0});
    checkpoint.seconds = seconds;
    const auto judge = [&](const Estimate& picture) {
        const PictureError error = picture_error(picture);
        run.discretisation.push_back(report_discretisation(film, picture, error));
        return error;
    };
    for (std::size_t i = 0; i <= run.pictures.bounces(); ++i) {
        run.term_errors.push_back(judge(run.pictures.term(i)));
        checkpoint.term_error.push_back(run.term_errors.back().all());
    }
    checkpoint.sum_error = judge(run.pictures.sum(run.pictures.bounces())).all();
    run.convergence.push_back(std::move(checkpoint));
    return run;
}

std::string seconds_text(double seconds) { return fmt::format("{:.{}f} s", seconds, seconds < 9.95 ? 1 : 0); }

class Steps {
public:
    Steps(const Scene& scene, const FieldGoal& goal, const FieldSettings& most)
        : goal_(goal), most_(most), errors_(most), costs_(scene.film) {}

    void add(const FieldRun& run, double seconds) {
        finest_ = run.pictures.sides.empty() ? 1 : run.pictures.sides.rbegin()->first;
        errors_.add(run.settings, finest_, run.term_errors);
        costs_.add(run.settings, run.pictures, seconds);
        last_ = run.settings;
        ++renders_;
    }

    WorstError worst() const { return errors_.worst(); }

    // The settings of the next render, or nothing if there should be none; why_not() then gives the reason.
    // `under_way`: settings of a render that was begun, or null.
    std::optional<FieldSettings> next(double seconds, const FieldSettings* under_way) {
        spent_ = seconds;
        if (same(last_, most_)) return stop(Outcome::samples_reached, "these are the largest settings");
        if (goal_.most && fits(most_)) return most_;
        if (renders_ == 1 && most_.samples > 1) {
            FieldSettings pilot = last_;
            pilot.samples = std::min(pilot_samples, most_.samples);
            if (fits(pilot)) return pilot;
            if (!under_way) return stop_short(pilot);
        }
        // A render that was begun goes on however little time is left, because most of it may be done.
        if (under_way) {
            FieldSettings settings = *under_way;
            settings.memory = most_.memory;
            return settings;
        }
        const double now = errors_.worst().error, target = std::max(goal_.relative_error.value_or(0.5 * now), now / most_growth);
        const FieldSettings step = errors_.grow(target, most_growth);
        if (within_reach() || fits_and_pays(step)) {
            if (!same(step, last_)) return step;
            return stop(Outcome::does_not_pay, "no part of what makes it would fall");
        }
        for (int i = 1; i <= shorter_steps; ++i) {
            const FieldSettings shorter = errors_.grow(target * std::pow(now / target, i / (shorter_steps + 1.0)), most_growth);
            if (!same(shorter, last_) && fits_and_pays(shorter)) return shorter;
        }
        return stop_short(step);
    }

    Outcome outcome() const { return outcome_; }
    std::string why_not() const {
        const WorstError now = worst();
        std::string text = goal_.relative_error ? fmt::format("an error of {:g} is not within reach: ", *goal_.relative_error) : "";
        text += fmt::format("the largest is {:.2g}, in bounce {}; {}", now.error, now.bounce, why_);
        if (errors_.stands(now.bounce)) {
            const auto k = static_cast<int>(std::lround(std::sqrt(finest_)));
            text += fmt::format(
                "; it hardly falls with more patches, for directions on mirrors, glass and rough metal are held in "
                "cells, {}×{} to a side at most",
                k, k);
        }
        return text;
    }

private:
    bool in_time(const FieldCost& cost) const { return !goal_.seconds || spent_ + caution * cost.seconds <= *goal_.seconds; }
    bool in_memory(const FieldCost& cost) const { return caution * cost.bytes <= most_.memory; }
    bool fits(const FieldSettings& settings) const {
        const FieldCost cost = costs_.predict(settings);
        return in_time(cost) && in_memory(cost);
    }
    // Whether the error can be reached at all, in any number of steps.
    bool within_reach() const {
        if (!goal_.relative_error) return false;
        const FieldSettings all = errors_.grow(*goal_.relative_error, without_limit);
        return errors_.predict(all).error <= *goal_.relative_error && fits(all);
    }
    double least_fall(const FieldSettings& settings) const {
        if (!goal_.relative_error) return 1.0 - least_gain;
        return std::pow(spent_ / (spent_ + costs_.predict(settings).seconds), least_slope);
    }
    bool pays(const FieldSettings& settings) const {
        return errors_.predict(settings).error <= least_fall(settings) * errors_.worst().error;
    }
    bool fits_and_pays(const FieldSettings& settings) const { return fits(settings) && pays(settings); }

    std::nullopt_t stop(Outcome outcome, std::string why) {
        outcome_ = outcome;
        why_ = std::move(why);
        return std::nullopt;
    }
    std::nullopt_t stop_short(const FieldSettings& step) {
        const FieldCost cost = costs_.predict(step);
        const std::string what = fmt::format(
            "another refinement, to {} patches, {} directions and {} samples, would take about {} and {:.2g} GiB and bring it to "
            "{:.2g}",
            step.patching.patches, std::uint64_t{step.rays} * step.replicates, std::uint64_t{step.samples} * step.replicates,
            seconds_text(cost.seconds), cost.bytes / 0x1p30, errors_.predict(step).error);
        if (!in_memory(cost))
            return stop(Outcome::memory_reached, fmt::format("{}, and {:.2g} GiB may be taken", what, most_.memory / 0x1p30));
        if (!in_time(cost))
            return stop(Outcome::time_reached,
                        fmt::format("{}, and {} are left", what, seconds_text(std::max(*goal_.seconds - spent_, 0.0))));
        return stop(Outcome::does_not_pay, what);
    }

    const FieldGoal goal_;
    const FieldSettings most_;
    FieldSettings last_;
    FieldErrors errors_;
    FieldCosts costs_;
    std::uint32_t finest_ = 1;
    std::size_t renders_ = 0;
    double spent_ = 0.0;
    Outcome outcome_ = Outcome::samples_reached;
    std::string why_;
};

std::optional<FieldPictures> render_by(FieldTeam* team, const Scene& scene, const FieldSettings& settings, const Watch& watch,
                                       FieldSaving* saving) {
    return team ? team->render(scene, settings, watch, saving) : render_fields(scene, settings, watch, nullptr, saving);
}

}  // namespace

std::optional<FieldRun> render_fields_once(const Scene& scene, const FieldSettings& settings, const Watch& watch, FieldTeam* team,
                                           FieldSaving* saving) {
    const Stopwatch clock;
    auto pictures = render_by(team, scene, settings, watch, saving);
    if (!pictures) return std::nullopt;
    if (saving) saving->has_all();
    return make_run(scene.film, std::move(*pictures), settings, {}, clock.seconds());
}

FieldSettings first_of_search(FieldSettings settings, const FieldSettings& most) {
    settings.patching.patches = std::min(fewest_patches, most.patching.patches);
    settings.rays = std::min(fewest_rays, most.rays);
    settings.light_samples = std::min(settings.rays, most.light_samples);
    settings.samples = 1;
    return settings;
}

std::optional<FieldRun> render_fields_to_goal(const Scene& scene, FieldSettings settings, const FieldGoal& goal, const Watch& watch,
                                              FieldTeam* team, FieldSaving* saving,
                                              const std::function<void(const FieldRun&)>& see) {
    const Stopwatch clock;
    const FieldSettings most = goal.most.value_or(largest(settings));
    const double end = goal.seconds ? 1.1 * *goal.seconds + 1.0 : std::numeric_limits<double>::infinity();
    settings = first_of_search(settings, most);
    auto first = render_fields_once(scene, settings, {.stop = [&] { return watch.stop() || clock.seconds() > end; }}, team);
    if (!first && watch.stop()) return std::nullopt;
    if (!first)
        throw RunError(
            fmt::format("the first pictures, from {} patches or one a face, were not finished in {}: no picture was written",
                        settings.patching.patches, seconds_text(end)));
    FieldRun& run = *first;
    Steps steps(scene, goal, most);
    steps.add(run, run.seconds);

    const auto tell = [&] {
        const double seconds = clock.seconds(), worst = steps.worst().error;
        RenderProgress progress{settings.bounces, run.pictures.samples, seconds, 0.0, std::nullopt};
        if (goal.relative_error && worst > 0.0) progress.fraction = *goal.relative_error / worst;
        if (goal.seconds) progress.fraction = std::max(progress.fraction, seconds / *goal.seconds);
        if (goal.seconds && !goal.relative_error) progress.seconds_left = std::max(*goal.seconds - seconds, 0.0);
        progress.fraction = std::min(progress.fraction, 1.0);
        watch.progress(progress);
    };
    const auto show = [&] {
        if (watch.show) watch.show(run.pictures.bounces(), [&](std::size_t i) { return joined_neighbours(run.pictures.term(i)); });
        if (see) see(run);
    };
    for (;;) {
        tell();
        show();
        if (goal.relative_error && steps.worst().error <= *goal.relative_error) {
            run.outcome = Outcome::error_reached;
            return first;
        }
        const double begin = clock.seconds();
        const FieldSettings* const under_way = saving && saving->from ? &saving->from->settings : nullptr;
        const auto next = steps.next(begin, under_way);
        if (!next) {
            run.outcome = steps.outcome();
            run.why = steps.why_not();
            return first;
        }
        const bool goes_on = under_way && same_pictures(*under_way, *next);
        Watch in_time = watch;
        in_time.stop = [&] {
            tell();
            return watch.stop() || clock.seconds() > end;
        };
        // A saved render that is under way must not be replaced by the smaller ones before it.
        auto pictures = render_by(team, scene, *next, in_time, under_way && !goes_on ? nullptr : saving);
        if (!pictures && under_way && watch.stop()) return std::nullopt;
        if (!pictures) {
            run.outcome = watch.stop() ? Outcome::interrupted : Outcome::time_reached;
            run.why = fmt::format(
                "the largest error is {:.2g}, in bounce {}; the next refinement took longer than foretold and was given up",
                steps.worst().error, steps.worst().bounce);
            return first;
        }
        if (goes_on) saving->from.reset();
        if (saving && !saving->from) saving->has_all();
        run = make_run(scene.film, std::move(*pictures), *next, std::move(run.convergence), clock.seconds());
        steps.add(run, std::max(clock.seconds() - begin, run.pictures.field_seconds + run.pictures.picture_seconds));
    }
}

}  // namespace neumann
