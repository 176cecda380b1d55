// Renders from fields on patches: patches, matrix and gather.
#include "apps/render_method.h"

#include "apps/health_json.h"
#include "apps/interrupt.h"
#include "core/base/error.h"
#include "core/base/stopwatch.h"
#include "core/scene/shading_normals.h"
#include "operators/pictures/field_goal.h"

#include <fmt/format.h>
#include <algorithm>
#include <bit>
#include <numeric>

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;

constexpr double default_seconds = 20.0, default_error = 0.02;

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
    if (request.seconds)
        throw InputError("--time belongs to the methods that make paths; " + request.method +
                         " takes --error, or --spp, --patches and --directions");
    FieldSettings settings;
    settings.method = request.importance ? FieldMethod::importance : field_method(request.method);
    settings.bounces = choose_bounces(job);
    settings.seed = request.seed;
    settings.rest = !request.only_pictures;
    if (settings.method == FieldMethod::gather) settings.gather_rays = 16;
    if (request.samples) {
        while (settings.replicates > 2 && *request.samples < settings.replicates) settings.replicates /= 2;
        settings.samples = share(*request.samples, settings.replicates);
    }
    if (request.patches) settings.patching.patches = *request.patches;
    if (request.directions) settings.rays = share(*request.directions, settings.replicates);
    return settings;
}

bool has_given_settings(const RenderRequest& request) { return request.samples || request.patches || request.directions; }

}  // namespace

RenderResult render_by_fields(const RenderJob& job) {
    const auto& [request, scene, pilot, plan, progress] = job;
    FieldSettings settings = choose_settings(job);
    if (request.relative_error && has_given_settings(request))
        throw InputError(
            "--error chooses patches, directions and samples by itself: --spp, --patches and --directions do not go with it");
    std::optional<Reference> reference;
    if (!request.reference.empty()) reference.emplace(request.reference, settings.bounces, scene.film);

    RenderObserver observer;
    observer.progress = [&](const RenderProgress& so_far) { job.progress(settings.bounces, so_far); };
    // Without any goal, what a short wait gives.
    const Stopwatch watch;
    observer.interrupted = [&] { return interrupted() || (!request.relative_error && watch.seconds() > default_seconds); };
    auto rendered = has_given_settings(request)
                        ? render_fields_once(scene, settings, interrupted)
                        : render_fields_to_error(scene, settings, request.relative_error.value_or(default_error), observer);
    if (!rendered) throw RunError("interrupted before the pictures were finished: nothing was written");
    FieldRun& run = *rendered;
    if (run.outcome == Outcome::interrupted && !interrupted()) run.outcome = Outcome::time_reached;
    if (reference)
        reference->judge([&](std::size_t i) { return run.pictures.term_mean(i); }, run.pictures.sum(run.pictures.bounces()).mean,
                         run.convergence.back());

    RenderResult result;
    if (has_shading_normals(scene)) result.warnings.add(patches_are_flat);
    result.series.report = report_series(scene, run.pictures);
    result.series.convergence = run.convergence;
    result.series.outcome = run.outcome;
    result.series.samples = run.pictures.samples;
    result.series.rays = run.convergence.back().rays;
    result.series.seconds = run.seconds;
    result.series.setup_seconds = run.pictures.field_seconds;
    result.series.degrees_of_freedom = run.settings.replicates - 1.0;
    if (run.pictures.rest_converges) result.series.rest = run.pictures.rest();
    const auto& errors = run.convergence.back().term_error;
    const double worst = *std::max_element(errors.begin(), errors.end());
    if (!has_given_settings(request) && run.outcome == Outcome::samples_reached)
        result.warnings.add(fmt::format("the error asked for was not reached with the largest settings: it is {:.2g}", worst));
    result.options = {{"bounces", settings.bounces}, {"method", request.method}, {"seed", settings.seed}};
    if (request.importance) result.options["importance"] = true;
    result.samples = {{"per_pixel", run.pictures.samples},
                      {"replicates", run.settings.replicates},
                      {"patches", run.pictures.patches},
                      {"unknowns", run.pictures.unknowns},
                      {"directions", std::uint64_t{run.settings.rays} * run.settings.replicates}};
    if (run.settings.method == FieldMethod::gather) result.samples["gather_rays_per_sample"] = run.settings.gather_rays;
    if (!run.pictures.rest_converges) result.rest["why"] = "the terms do not fall, or too slowly to add them up";
    result.health = [power = run.pictures.power](const std::string&) { return as_json(power); };
    const auto pictures = std::make_shared<FieldPictures>(std::move(run.pictures));
    result.series.term = [pictures](std::size_t i) { return pictures->term(i); };
    result.series.sum = [pictures](std::size_t i) { return pictures->sum(i); };
    return result;
}

}  // namespace neumann
