// study.json: all results of a study, and everything needed to repeat it.
#include "apps/output/files/json_number.h"
#include "apps/output/files/scene_json.h"
#include "apps/output/study/study_data.h"
#include "core/geometry/ray_caster.h"
#include "operators/statistics/metrics.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;

Json as_json(const WithError& x) { return {{"value", json_number(x.value)}, {"standard_error", json_number(x.standard_error)}}; }

Json as_json(const std::optional<ErrorSlope>& slope) {
    if (!slope) return nullptr;
    return {{"value", slope->slope}, {"interval95", json_number(slope->half_width)}, {"points", slope->points}};
}

Json as_json(const StudyData& data, const StudyPoint& point, std::size_t q, const PointSummary& summary) {
    const StudyRun& run = point.runs.front();
    Json json = {{"budget", data.plan.budgets[point.budget()]},
                 {"missed_budget", missed_budget(data.plan, point).has_value()},
                 {"samples", run.samples}};
    if (run.patches) json["patches"] = run.patches;
    if (run.directions) json["directions"] = run.directions;
    json["setup_seconds"] = as_json(summary.setup_seconds);
    json["sampling_seconds"] = as_json(summary.sampling_seconds);
    json["seconds"] = as_json(summary.seconds);
    json["rays"] = point.mean_rays(q);
    json["peak_memory"] = point.largest_memory();
    json["rmse"] = as_json(summary.rmse);
    json["resolved"] = summary.resolved;
    json["rel_mse"] = as_json(summary.rel_mse);
    json["variance"] = as_json(summary.variance);
    json["bias_squared"] = {{"value", json_number(summary.bias_squared.value)},
                            {"interval95", json_number(summary.bias_half_width)},
                            {"significant", summary.biased}};
    if (const auto mean = point.mean_discretisation(q)) json["discretisation_as_estimated_by_the_method"] = *mean;
    json["efficiency"] = json_number(summary.efficiency);
    json["efficiency_with_bias"] = json_number(summary.merit);
    json["infinite_variance"] = summary.infinite_variance;
    return json;
}

Json as_json(const StudyData& data, std::size_t q, const StudyVerdict& verdict) {
    Json json = {{"text", verdict_text(data, q, verdict)},
                 {"best", data.methods[verdict.best].name},
                 {"known", verdict.is_known},
                 {"own_error", verdict.own_error ? Json(*verdict.own_error) : Json(nullptr)},
                 {"others", Json::array()}};
    for (const SpeedRatio& other : verdict.others)
        json["others"].push_back({{"method", data.methods[other.method].name},
                                  {"times_as_fast", json_number(other.times.ratio)},
                                  {"low", json_number(other.times.low)},
                                  {"high", json_number(other.times.high)},
                                  {"known", other.is_known},
                                  {"seen", other.is_seen()}});
    return json;
}

Json as_json(const StudyData& data, const ComparedCrop& crop) {
    Json json = {{"x", crop.place.x},           {"y", crop.place.y},      {"width", crop.place.width},
                 {"height", crop.place.height}, {"given", crop.is_given}, {"methods", Json::array()}};
    for (const MethodCrop& m : crop.methods)
        json["methods"].push_back({{"method", data.methods[m.method].name}, {"rmse", as_json(m.rmse)}});
    return json;
}

Json as_json(const StudyData& data, std::size_t q, const StudiedMethod& method) {
    const PictureSummary& s = method.summary;
    Json json = {{"rank", s.rank}, {"method", data.methods[method.method].name}, {"infinite_variance", s.infinite_variance}};
    json["slope"] = as_json(s.slope);
    json["slope_by_samples"] = as_json(s.slope_by_samples);
    json["seconds_to_error"] = nullptr;
    if (s.seconds_to_error)
        json["seconds_to_error"] = {{"seconds", s.seconds_to_error->work}, {"or_less", s.seconds_to_error->below}};
    json["points"] = Json::array();
    const auto points = points_of_method(data.points, method.method);
    for (std::size_t b = 0; b < points.size(); ++b) json["points"].push_back(as_json(data, *points[b], q, s.points[b]));
    return json;
}

Json truncation(const StudyData& data) {
    Json json;
    if (data.bounces > data.pilot.bounces() || !data.pilot.converges()) {
        json["note"] = "not known: the walks that look for it did not end";
        return json;
    }
    const MeanWithError rest = data.pilot.rest(data.bounces);
    json["rest_mean"] = rest.mean;
    json["interval95"] = json_number(rest.interval());
    json["fraction_of_whole"] = json_number(rest.mean / data.pilot.sum());
    json["note"] =
        "mean of all bounces beyond the last one, by walks of their own; no error above contains it, the sum is that of the "
        "bounces that are looked at";
    return json;
}

}  // namespace

Json study_json(const StudyData& data, const std::vector<StudiedPicture>& pictures) {
    const StudyRequest& request = data.request;
    Json json;
    json["program"] = {{"name", "neumann"}, {"version", NEUMANN_VERSION}, {"ray_caster", embree_version()}};
    json["command"] = request.command_line;
    json["complete"] = data.complete;
    json["verdict"] = verdict_text(data, pictures.size() - 1, verdict_on(pictures.back(), data.fewest_repeats()));
    json["scene"] = scene_json(data.scene, request.scene);
    json["picture"] = {{"width", data.scene.film.crop_width}, {"height", data.scene.film.crop_height}};
    json["bounces"] = data.bounces;
    json["verdict_on"] = data.picture_name(data.pictures() - 1);
    json["repeats"] = request.repeats;
    if (request.interval) json["interval"] = *request.interval;
    json["seed"] = request.seed;
    json["threads"] = oneapi::tbb::global_control::active_value(oneapi::tbb::global_control::max_allowed_parallelism);
    json["budgets"] = {{"unit", data.plan.budgets_are_samples ? "samples a pixel" : "seconds of a run"},
                       {"values", data.plan.budgets}};
    json["setup"] = {
        {"scene_seconds", data.scene_seconds},
        {"pilot_seconds", data.pilot_seconds},
        {"note",
         "once for all methods: reading the scene and building its search structures; walks that choose the bounces. What a "
         "method prepares in each run is in its points"}};
    json["peak_memory"] = data.peak_is_of_run ? "of the whole program in that run, scene and reference included"
                                              : "of the whole program up to that run: the system does not let it be measured anew";
    json["reference"] = {{"description", data.reference.description},
                         {"exact", data.reference.exact},
                         {"from_cache", data.reference.from_cache},
                         {"seconds", data.reference.seconds},
                         {"identity", data.reference.identity}};
    if (!data.reference.choice.empty()) json["reference"]["choice"] = data.reference.choice;
    json["truncation"] = truncation(data);
    json["definitions"] = {
        {"mse",
         fmt::format("mean over pixels and channels of (x - r)^2, the reference's noise subtracted; relMSE over r^2 + {} mean(r)^2",
                     metrics_epsilon)},
        {"variance", "of a picture, over the repeats"},
        {"bias_squared",
         "mse - variance, signed; the interval is that of the repeats and of the reference; significant: above 0 at 99.9%"},
        {"seconds",
         "medians over the repeats, of a whole run with all its bounces, as measured; setup is what comes before the first sample"},
        {"efficiency",
         "1 / (variance * seconds); with bias 1 / (mse * seconds), by which methods are ranked at their largest budget"},
        {"times_as_fast",
         "1 / (mse * seconds) of the best method over that of another, at their largest budgets; the intervals of all pairs of "
         "methods hold together at 95% (Fieller, Bonferroni); seen: the interval does not hold 1"},
        {"slope", "of log RMSE against log seconds, by weighted least squares"}};
    json["methods"] = Json::array();
    for (std::size_t m = 0; m < data.methods.size(); ++m) {
        Json method = {{"name", data.methods[m].name}, {"fields", has_fields(data.methods[m].method)}};
        const auto points = points_of_method(data.points, m);
        if (!points.empty() && !data.methods[m].own)
            method["repeat_the_first_run"] = repeating_command(data, points.front()->runs.front());
        json["methods"].push_back(method);
    }
    json["pictures"] = Json::array();
    for (std::size_t q = 0; q < pictures.size(); ++q) {
        const StudiedPicture& p = pictures[q];
        Json picture = {{"bounce", data.picture_name(q)},
                        {"reference_rms", p.reference_size},
                        {"reference_noise_subtracted", p.reference_noise},
                        {"given_error", p.error},
                        {"verdict", as_json(data, q, verdict_on(p, data.fewest_repeats()))},
                        {"methods", Json::array()}};
        for (const StudiedMethod& m : p.methods) picture["methods"].push_back(as_json(data, q, m));
        json["pictures"].push_back(picture);
    }
    json["crops"] = Json::array();
    for (const ComparedCrop& crop : data.crops) json["crops"].push_back(as_json(data, crop));
    json["warnings"] = Json::array();
    for (const std::string& warning : data.warnings()) json["warnings"].push_back(warning);
    return json;
}

}  // namespace neumann
