#include "apps/run_json.h"

#include "core/geometry/ray_caster.h"

#include <cmath>

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;

// JSON has no infinity.
Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json mean_json(const MeanWithError& mean, bool infinite_variance) {
    Json json = {{"mean", number(mean.mean)}};
    if (infinite_variance) {
        json["interval95"] = "none: the variance is infinite";
        return json;
    }
    json["stderr"] = number(mean.standard_error);
    json["degrees_of_freedom"] = number(mean.degrees_of_freedom);
    json["interval95"] = number(mean.interval());
    return json;
}

const char* name(Outcome outcome) {
    switch (outcome) {
        case Outcome::samples_reached:
            return "samples reached";
        case Outcome::time_reached:
            return "time reached";
        case Outcome::error_reached:
            return "error reached";
        case Outcome::interrupted:
            return "interrupted";
    }
    return "";
}

const char* name(DirectLight direct) {
    switch (direct) {
        case DirectLight::light:
            return "light";
        case DirectLight::bsdf:
            return "bsdf";
        case DirectLight::mis:
            return "mis";
    }
    return "";
}

Json rest_json(const Scene& scene, const PictureSampler::Settings& settings, const Pilot& pilot, const RenderedSeries& series,
               const SeriesReport& report) {
    const double bound = report.bounces.back().bound;
    Json json;
    switch (report.rest_verdict) {
        case RestVerdict::measured:
            json = mean_json(report.rest, report.rest_infinite_variance);
            json["verdict"] = "measured";
            json["fraction_of_sum_with_interval"] = number(report.tail_fraction());
            json["probability_of_being_sampled"] = settings.walk.rest_probability;
            json["walks_given_up"] = series.tally.given_up;
            break;
        case RestVerdict::not_converging:
            json["verdict"] = "not converging";
            json["why"] = std::to_string(pilot.given_up()) + " of " + std::to_string(pilot.walks()) +
                          " walks had not ended after " + std::to_string(Pilot::bounces + Pilot::give_up) +
                          " bounces and were given up";
            break;
        case RestVerdict::not_sampled:
            json["verdict"] = "not sampled by this method";
            break;
    }
    json["a_priori_bound"] = number(bound);
    json["a_priori_bound_note"] =
        std::isfinite(bound) ? "a^(N+1)/(1-a) * largest emitted radiance, a = largest albedo; of the sup norm, channel by channel"
                             : "there is no bound: the largest albedo is at least 1";
    if (report.bounces.back().ratio) json["ratio_estimate"] = *report.bounces.back().ratio;
    const Rgb albedo = scene.materials.largest_albedo();
    json["largest_albedo"] = {albedo.r, albedo.g, albedo.b};
    return json;
}

}  // namespace

Json run_json(const RenderRequest& request, const Scene& scene, const PictureSampler::Settings& settings, const Pilot& pilot,
              const RenderedSeries& series, const SeriesReport& report, const Warnings& warnings, double seconds_total) {
    Json json;
    json["program"] = {{"name", "neumann"}, {"version", NEUMANN_VERSION}, {"ray_caster", embree_version()}};
    json["command"] = request.command_line;
    json["scene"] = {{"file", request.scene}, {"hash", scene.hash}, {"definitions", request.definitions}};
    json["picture"] = {{"width", scene.film.crop_width}, {"height", scene.film.crop_height}};
    json["options"] = {{"bounces", settings.walk.bounces},
                       {"method", request.method},
                       {"direct", name(settings.walk.direct)},
                       {"sampler", settings.sampler == SamplerKind::sobol ? "sobol" : "independent"},
                       {"seed", settings.seed}};
    json["samples"] = {{"per_pixel", series.samples},
                       {"replicate_size", series.replicate_size},
                       {"replicates", series.moments.replicates()},
                       {"degrees_of_freedom", series.moments.result().degrees_of_freedom()},
                       {"outcome", name(series.outcome)}};
    std::uint64_t rays = 0;
    for (const std::uint64_t r : series.tally.rays) rays += r;
    json["timing"] = {{"sampling_seconds", series.seconds}, {"total_seconds", seconds_total}, {"rays", rays}};
    json["sum"] = mean_json(report.sum, report.infinite_variance());
    json["bounces"] = Json::array();
    for (const BounceReport& b : report.bounces) {
        Json bounce = mean_json(b.mean, b.infinite_variance);
        if (b.ratio) bounce["ratio_estimate"] = *b.ratio;
        bounce["tail_bound"] = number(b.bound);
        if (b.tail) bounce["tail_index"] = {{"estimate", b.tail->alpha}, {"upper_99.9", b.tail->upper}};
        bounce["rays"] = b.rays;
        json["bounces"].push_back(bounce);
    }
    json["rest"] = rest_json(scene, settings, pilot, series, report);
    json["non_finite_samples"] = {{"count", series.tally.non_finite_count}, {"first", Json::array()}};
    for (const NonFiniteSample& s : series.tally.non_finite)
        json["non_finite_samples"]["first"].push_back({{"x", s.x}, {"y", s.y}, {"bounce", s.bounce}, {"sample", s.sample}});
    json["warnings"] = Json::array();
    for (const auto& [text, count] : warnings.counts()) json["warnings"].push_back({{"text", text}, {"count", count}});
    return json;
}

}  // namespace neumann
