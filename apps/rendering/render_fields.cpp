// Renders from fields on patches: patches, matrix and gather.
#include "apps/rendering/render_method.h"

#include "apps/commands/interrupt.h"
#include "apps/commands/limits.h"
#include "apps/files/health_json.h"
#include "core/base/error.h"
#include "core/scene/shading_normals.h"
#include "operators/pictures/field_goal.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <bit>
#include <numeric>

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;

// Of a replicate, with --patches or --directions and without --spp: about what default_error takes.
constexpr std::uint32_t default_samples = 16;
// Means that are known less well than to this part are told of.
constexpr double wide_interval = 0.1;
// Of a facet, where --directions is given: as many as rays of T, in between. So do renders that choose their settings by
// themselves, which is why theirs can be repeated.
constexpr std::uint32_t fewest_light_samples = 16, most_light_samples = 64;

FieldMethod field_method(const std::string& name) {
    return name == "patches" ? FieldMethod::patches : name == "matrix" ? FieldMethod::matrix : FieldMethod::gather;
}

// Of all replicates; in each, at least one, and a power of two.
std::uint32_t share(std::uint64_t all, std::uint32_t replicates) {
    return static_cast<std::uint32_t>(std::bit_floor(std::clamp<std::uint64_t>(all / replicates, 1, 1u << 20)));
}

FieldSettings choose_settings(const RenderJob& job) {
    const RenderRequest& request = job.request;
    check_light_options(request.light, request.method);
    if (!request.sampler.empty()) throw InputError("--sampler belongs to the methods that make paths, not to " + request.method);
    FieldSettings settings;
    settings.method = request.importance ? FieldMethod::importance : field_method(request.method);
    settings.bounces = choose_bounces(job);
    settings.seed = request.seed;
    settings.rest = !request.only_pictures;
    if (settings.method == FieldMethod::gather) settings.gather_rays = 16;
    if (request.samples) {
        while (settings.replicates > 2 && *request.samples < settings.replicates) settings.replicates /= 2;
        settings.samples = share(*request.samples, settings.replicates);
    } else if (request.patches || request.directions) {
        settings.samples = default_samples;
    }
    if (request.patches) settings.patching.patches = *request.patches;
    if (request.directions) {
        settings.rays = share(*request.directions, settings.replicates);
        settings.light_samples = std::clamp(settings.rays, fewest_light_samples, most_light_samples);
    }
    settings.memory = memory_limit(request.memory);
    return settings;
}

bool has_given_settings(const RenderRequest& request) { return request.samples || request.patches || request.directions; }

void warn_of_wide_intervals(const SeriesReport& report, Warnings& warnings) {
    std::vector<std::size_t> wide;
    for (std::size_t i = 0; i < report.bounces.size(); ++i) {
        const MeanWithError& m = report.bounces[i].mean;
        if (m.interval() > wide_interval * std::abs(m.mean)) wide.push_back(i);
    }
    if (wide.empty()) return;
    warnings.add(fmt::format("the mean's interval is wider than {:.0f}% of it in bounce {}; more samples (--spp) make it narrower",
                             100.0 * wide_interval, fmt::join(wide, ", ")));
}

FieldGoal choose_goal(const RenderRequest& request, const FieldSettings& settings) {
    FieldGoal goal{request.relative_error, request.seconds, std::nullopt};
    if (has_given_settings(request)) goal.most = settings;
    // Without any goal, what a short wait gives.
    if (!goal.relative_error && !goal.seconds) goal = {default_error, default_seconds, std::nullopt};
    if (!goal.seconds) goal.seconds = longest_search;
    return goal;
}

}  // namespace

RenderResult render_by_fields(const RenderJob& job) {
    const auto& [request, scene, pilot, plan, progress, chosen] = job;
    FieldSettings settings = choose_settings(job);
    if (request.relative_error && has_given_settings(request))
        throw InputError(
            "--error chooses patches, directions and samples by itself: --spp, --patches and --directions do not go with it");
    std::optional<Reference> reference;
    if (!request.reference.empty()) reference.emplace(request.reference, settings.bounces, scene.film);

    RenderObserver observer;
    observer.progress = [&](const RenderProgress& so_far) { job.progress(settings.bounces, so_far); };
    observer.interrupted = interrupted;
    const bool given = has_given_settings(request);
    auto rendered = given && !request.seconds
                        ? render_fields_once(scene, settings, interrupted)
                        : std::optional(render_fields_to_goal(scene, settings, choose_goal(request, settings), observer));
    if (!rendered) throw RunError("interrupted before the pictures were finished: nothing was written");
    FieldRun& run = *rendered;
    if (reference)
        reference->judge([&](std::size_t i) { return run.pictures.term_mean(i); }, run.pictures.sum(run.pictures.bounces()).mean,
                         run.convergence.back());

    RenderResult result;
    if (has_shading_normals(scene)) result.warnings.add(patches_are_flat);
    result.series.report = report_series(scene, run.pictures);
    warn_of_wide_intervals(result.series.report, result.warnings);
    result.series.convergence = run.convergence;
    result.series.outcome = run.outcome;
    result.series.samples = run.pictures.samples;
    result.series.rays = run.convergence.back().rays;
    result.series.seconds = run.seconds;
    result.series.setup_seconds = run.pictures.field_seconds;
    result.series.degrees_of_freedom = run.settings.replicates - 1.0;
    if (run.pictures.rest_converges) {
        result.series.rest = run.pictures.rest();
        result.series.means_of_rest = run.pictures.means_of_rest();
    }
    // Without --error, to be out of time is no surprise.
    const bool ended_early = run.outcome == Outcome::memory_reached || run.outcome == Outcome::does_not_pay;
    if (!run.why.empty() && (request.relative_error || ended_early)) result.warnings.add(run.why);
    result.options = {{"bounces", settings.bounces}, {"method", request.method}, {"seed", settings.seed}};
    // With these and --spp it is repeated.
    if (!given || request.seconds || request.patches) result.options["patches"] = run.settings.patching.patches;
    if (!given || request.directions || run.settings.rays != settings.rays)
        result.options["directions"] = std::uint64_t{run.settings.rays} * run.settings.replicates;
    if (request.importance) result.options["importance"] = true;
    result.samples = {{"per_pixel", run.pictures.samples},
                      {"replicates", run.settings.replicates},
                      {"patches", run.pictures.patches},
                      {"unknowns", run.pictures.unknowns},
                      {"directions", std::uint64_t{run.settings.rays} * run.settings.replicates}};
    if (!run.why.empty()) result.samples["why"] = run.why;
    if (run.settings.method == FieldMethod::gather) result.samples["gather_rays_per_sample"] = run.settings.gather_rays;
    if (!run.pictures.rest_converges) result.rest["why"] = "the terms do not fall, or too slowly to add them up";
    result.health = [power = run.pictures.power](const std::string&) { return as_json(power); };
    const auto pictures = std::make_shared<FieldPictures>(std::move(run.pictures));
    result.series.term = [pictures](std::size_t i) { return pictures->term(i); };
    result.series.sum = [pictures](std::size_t i) { return pictures->sum(i); };
    result.series.means_of_term = [pictures](std::size_t i) { return pictures->means_of_term(i); };
    result.series.means_of_sum = [pictures](std::size_t i) { return pictures->means_of_sum(i); };
    return result;
}

}  // namespace neumann
