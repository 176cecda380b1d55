// Renders from fields on patches.
#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/base/stopwatch.h"
#include "core/scene/normal_maps.h"
#include "operators/fields/matrix/sides.h"
#include "operators/render/from_fields/field_goal.h"
#include "operators/render/methods/crew.h"
#include "operators/render/methods/preparation.h"
#include "operators/render/methods/render_job.h"
#include "operators/render/report/unmet_by_fields.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>

namespace neumann {

namespace {

// Samples per pixel of a replicate if patches or directions are given alone: about enough for default_error.
constexpr std::uint32_t default_samples = 16;
// Warn if the 95% interval of a mean is wider than this part of the mean.
constexpr double wide_interval = 0.1;
// If directions are given, a facet has as many light samples as rays of T, clamped to this range. Renders that choose their own
// settings use the same rule, so they can be repeated from the directions.
constexpr std::uint32_t fewest_light_samples = 16, most_light_samples = 64;

template <class M>
FieldReading kind(const M& m) {
    if constexpr (std::same_as<M, method::Matrix>) return FieldReading::matrix;
    if constexpr (std::same_as<M, method::Gather>) return FieldReading::gather;
    if constexpr (std::same_as<M, method::Patches>) return m.importance ? FieldReading::importance : FieldReading::patches;
}

// One replicate's share of `all`: a power of two, and at least 1.
std::uint32_t share(std::uint64_t all, std::uint32_t replicates) {
    return static_cast<std::uint32_t>(std::bit_floor(std::clamp<std::uint64_t>(all / replicates, 1, 1u << 20)));
}

bool is_given(const method::FieldOptions& options, const Goal& goal) {
    return goal.samples || options.patches || options.directions;
}

template <HasFields M>
FieldSettings choose_settings(const M& m, const RenderJob& job) {
    const Goal& goal = job.goal;
    FieldSettings settings;
    settings.reading = kind(m);
    settings.bounces = choose_bounces(job);
    settings.seed = goal.seed;
    settings.rest = !goal.only_pictures;
    if (settings.reading == FieldReading::gather) settings.gather_rays = 16;
    if (goal.replicates) {
        settings.samples = share_of_replicate(goal);
        settings.replicates = *goal.replicates;
    } else if (goal.samples) {
        while (settings.replicates > 2 && *goal.samples < settings.replicates) settings.replicates /= 2;
        settings.samples = share(*goal.samples, settings.replicates);
    } else if (m.patches || m.directions) {
        settings.samples = default_samples;
    }
    if (m.patches) settings.patching.patches = *m.patches;
    if (m.directions) {
        settings.rays = share(*m.directions, settings.replicates);
        settings.light_samples = std::clamp(settings.rays, fewest_light_samples, most_light_samples);
    }
    settings.memory = goal.memory.value_or(default_memory());
    return settings;
}

void warn_of_wide_intervals(const SeriesReport& report, Warnings& warnings) {
    std::vector<std::size_t> wide;
    for (std::size_t i = 0; i < report.bounces.size(); ++i) {
        const MeanWithError& m = report.bounces[i].mean;
        if (m.interval() > wide_interval * std::abs(m.mean)) wide.push_back(i);
    }
    if (wide.empty()) return;
    warnings.add(fmt::format("the mean's interval is wider than {:.0f}% of it in bounce {}; more samples make it narrower",
                             100.0 * wide_interval, fmt::join(wide, ", ")));
}

FieldGoal choose_goal(const Goal& goal, const FieldSettings& settings, bool given, double spent) {
    FieldGoal chosen{goal.relative_error, goal.seconds, std::nullopt};
    if (given) chosen.most = settings;
    if (!chosen.relative_error && !chosen.seconds) chosen = {default_error, default_seconds, std::nullopt};
    if (!chosen.seconds) chosen.seconds = longest_search;
    chosen.seconds = std::max(*chosen.seconds - spent, 0.0);
    return chosen;
}

// The series of a run's pictures, which the series and the run may share.
BounceSeries as_series(const std::shared_ptr<const FieldPictures>& pictures, const FieldRun& run, const Scene& scene) {
    BounceSeries series;
    series.term = [pictures](std::size_t i) { return pictures->term(i); };
    series.sum = [pictures](std::size_t i) { return pictures->sum(i); };
    series.means_of_term = [pictures](std::size_t i) { return pictures->means_of_term(i); };
    series.means_of_sum = [pictures](std::size_t i) { return pictures->means_of_sum(i); };
    if (pictures->rest_converges) {
        series.rest = pictures->rest();
        series.means_of_rest = pictures->means_of_rest();
        series.limit = [pictures] { return pictures->sum(pictures->bounces() + 1); };
    }
    series.report = report_series(scene, *pictures, run.discretisation);
    if (!pictures->importance) report_unmet(series.report, scene, *pictures, run.settings);
    series.convergence = run.convergence;
    series.outcome = run.outcome;
    series.samples = pictures->samples;
    series.rays = run.convergence.back().rays;
    series.seconds = run.seconds;
    series.setup_seconds = pictures->field_seconds;
    series.degrees_of_freedom = run.settings.replicates - 1.0;
    FieldRecord record;
    record.replicates = run.settings.replicates;
    record.patches = pictures->patches;
    record.unknowns = pictures->unknowns;
    record.directions = std::uint64_t{run.settings.rays} * run.settings.replicates;
    if (run.settings.reading == FieldReading::gather) record.gather_rays = run.settings.gather_rays;
    record.why = run.why;
    if (!pictures->rest_converges) record.why_no_rest = "the terms do not fall, or too slowly to add them up";
    record.power = pictures->power;
    series.record = std::move(record);
    return series;
}

// Whether light from mirrors is missed: links find it (operators/fields/matrix/link_light.h), light in a cell does not.
template <HasFields M>
bool misses_mirrored_light(const Scene& scene, const M& m) {
    const FieldReading reading = kind(m);
    const bool has_links =
        (reading == FieldReading::matrix || reading == FieldReading::gather) && glossy_of_pictures(scene) == Glossy::by_rays;
    return reading != FieldReading::importance && !has_links && scene.emitters.has_delta_lights() && has_specular(scene.materials);
}

template <HasFields M>
BounceSeries render_by(M m, const RenderJob& job) {
    const Goal& goal = job.goal;
    if (goal.colors) throw InputError("fields on patches have linear RGB alone");
    const bool given = is_given(m, goal), importance = std::same_as<M, method::Patches> && kind(m) == FieldReading::importance;
    if (importance && goal.tail)
        throw OptionError("tail", " counts bounces by what is left of the light, not of importance; give their number");
    const std::optional<double> seconds = with_default_limits(goal).seconds;
    if (seconds && !given && !job.saving.from) Preparations(job.scene, job.pilot()).in_time(*seconds, m);
    FieldSettings settings = choose_settings(m, job);
    if (goal.relative_error && given)
        throw OptionError("error", " chooses patches, directions and samples by itself, and none of these goes with it");
    FieldSaving saving;
    if (job.saving.from) saving.from = std::move(job.saving.from->fields);
    const bool searches = !given || goal.seconds;
    if (saving.from &&
        !(searches ? !given || is_within(saving.from->settings, settings) : same_pictures(saving.from->settings, settings)))
        saving.from.reset();  // other settings make other pictures
    const double seconds_before = saving.from ? saving.from->seconds : 0.0;
    const Stopwatch clock;
    saving.is_due = job.saving.fields_are_due;
    saving.has_all = job.saving.has_all_fields;
    saving.keep = [&](FieldProgress& progress) {
        progress.seconds = seconds_before + clock.seconds();
        job.saving.keep_fields({m, goal.seed, settings.bounces, 0.0, settings.samples}, job.choice, progress);
    };
    // Importance is carried by T*, whose columns are on all processes, so this process makes its pictures alone.
    const std::unique_ptr<FieldTeam> team = job.watch.crew && !importance ? job.watch.crew->begin_fields(m) : nullptr;
    if (team) settings.memory /= team->on_this_machine();
    std::function<void(const FieldRun&)> see;
    if (job.saving.see)
        see = [&](const FieldRun& run) {
            job.saving.see([&] {
                BounceSeries series = as_series({std::shared_ptr<void>(), &run.pictures}, run, job.scene);
                series.method = m;
                describe(series, job);
                return series;
            });
        };
    auto rendered = searches ? render_fields_to_goal(job.scene, settings,
                                                     choose_goal(goal, settings, given, job.seconds_gone() + seconds_before),
                                                     job.watch, team.get(), &saving, see)
                             : render_fields_once(job.scene, settings, job.watch, team.get(), &saving);
    if (!rendered) throw Stopped("interrupted before the pictures were finished: none was written");
    FieldRun& run = *rendered;
    run.seconds += seconds_before;
    for (Checkpoint& checkpoint : run.convergence) checkpoint.seconds += seconds_before;
    const auto pictures = std::make_shared<FieldPictures>(std::move(run.pictures));
    if (job.watch.judge)
        job.watch.judge([&](std::size_t i) { return pictures->term_mean(i); }, pictures->sum(pictures->bounces()).mean,
                        run.convergence.back());

    BounceSeries series = as_series(pictures, run, job.scene);
    if (has_normal_maps(job.scene)) series.warnings.add(patches_are_flat);
    if (misses_mirrored_light(job.scene, m))
        series.warnings.add(
            "what a mirror throws on from a light without extent is not found by patches whose directions are divided into cells, "
            "and is missing");
    warn_of_wide_intervals(series.report, series.warnings);
    // Running out of time is worth a warning only if there was an error to reach.
    const bool ended_early = run.outcome == Outcome::memory_reached || run.outcome == Outcome::does_not_pay;
    if (!run.why.empty() && (goal.relative_error || ended_early)) series.warnings.add(run.why);

    // Record the settings that, with the same number of samples, repeat the render.
    if (!given || goal.seconds || m.patches) m.patches = run.settings.patching.patches;
    if (!given || m.directions || run.settings.rays != settings.rays)
        m.directions = static_cast<std::uint32_t>(std::get<FieldRecord>(series.record).directions);
    series.method = m;
    return series;
}
}  // namespace

BounceSeries render_by_fields(const Method& method, const RenderJob& job) {
    return std::visit(
        [&]<class M>(const M& m) -> BounceSeries {
            if constexpr (HasFields<M>)
                return render_by(m, job);
            else
                throw InputError(fmt::format("{} has no fields on patches", M::name));
        },
        method);
}

}  // namespace neumann
