#include "apps/output/run_json.h"

#include "apps/output/files/health_json.h"
#include "apps/output/files/json_number.h"
#include "apps/output/files/method_json.h"
#include "apps/output/files/plan_json.h"
#include "apps/output/files/request_json.h"
#include "apps/output/files/scene_json.h"
#include "apps/output/files/ways_files.h"
#include "core/geometry/ray_caster.h"
#include "operators/render/from_paths/cache_sampler.h"
#include "operators/render/from_paths/mixed_sampler.h"
#include "operators/render/from_paths/photon_sampler.h"
#include "operators/render/from_paths/walk_paths.h"

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;

Json mean_json(const MeanWithError& mean, bool infinite_variance, bool rare_large_samples = false, bool unmet = false) {
    Json json = {{"mean", json_number(mean.mean)}};
    if (infinite_variance) {
        json["interval95"] = "none: the variance is infinite";
        return json;
    }
    json["stderr"] = json_number(mean.standard_error);
    json["degrees_of_freedom"] = json_number(mean.degrees_of_freedom);
    json["interval95"] = json_number(mean.interval());
    if (unmet) json["unmet"] = "no sample met it: interval95 is an upper bound";
    if (rare_large_samples) json["rare_large_samples"] = true;
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
        case Outcome::memory_reached:
            return "memory reached";
        case Outcome::does_not_pay:
            return "more does not pay";
    }
    return "";
}

const char* name(Paths paths) {
    switch (paths) {
        case Paths::all:
            return "all";
        case Paths::without_specular:
            return "a subset: those without specular reflections";
        case Paths::without_caustics:
            return "a subset: those whose light does not come from a mirror or through glass onto the first other surface";
        case Paths::seen_directly:
            return "a subset: those that the camera sees on surfaces, and not in a mirror or through glass";
        case Paths::specular:
            return "a subset: those whose reflections are specular but for the last one, which looks for light";
    }
    return "";
}

Json rest_json(const Scene& scene, const BounceSeries& series) {
    const SeriesReport& report = series.report;
    const double bound = report.bounces.back().bound;
    Json json;
    switch (report.rest_verdict) {
        case RestVerdict::measured:
            json = mean_json(report.rest, report.rest_infinite_variance, report.rest_rare_large_samples, report.rest_unmet);
            json["verdict"] = "measured";
            json["fraction_of_sum_with_interval"] = json_number(report.tail_fraction());
            break;
        case RestVerdict::not_converging:
            json["verdict"] = "not converging";
            break;
        case RestVerdict::not_sampled:
            json["verdict"] = "not sampled by this method";
            break;
    }
    if (const auto* paths = std::get_if<PathRecord>(&series.record); paths && paths->rest_probability) {
        json["probability_of_being_sampled"] = *paths->rest_probability;
        json["walks_given_up"] = paths->walks_given_up;
    }
    const std::string why = std::visit([](const auto& record) { return record.why_no_rest; }, series.record);
    if (!why.empty()) json["why"] = why;
    json["a_priori_bound"] = json_number(bound);
    json["a_priori_bound_note"] =
        report.importance      ? "there is no bound: the largest importance is infinite"
        : std::isfinite(bound) ? "a^(N+1)/(1-a) * largest emitted radiance, a = largest albedo; of the sup norm, channel by channel"
                               : "there is no bound: the largest albedo is at least 1";
    if (report.bounces.back().ratio) json["ratio_estimate"] = *report.bounces.back().ratio;
    const Rgb albedo = scene.materials.largest_albedo();
    json["largest_albedo"] = {albedo.r, albedo.g, albedo.b};
    return json;
}

void add_discretisation(Json& json, const std::optional<DiscretisationReport>& report) {
    if (!report) return;
    json["discretisation"] = {{"mean", report->mean},
                              {"worst", report->worst},
                              {"worst_pixel", {report->worst_x, report->worst_y}},
                              {"relative", report->relative}};
}

// The photon maps of the first and the last replicate, and where the lights' power goes, by the photons of the pilot.
Json photons_json(const PhotonPilot& photons, const PathRecord& record, std::size_t bounces) {
    const PhotonSettings& settings = photons.settings;
    const std::uint64_t last = record.first_replicate + std::max<std::size_t>(record.replicates, 1) - 1;
    const auto radii = [&](double radius) {
        return Json{radius * relative_radius(record.first_replicate), radius * relative_radius(last)};
    };
    Json json = {
        {"paths", settings.paths},
        {"caustic", {{"photons", photons.caustic_photons}, {"largest_radius_first_last", radii(settings.caustic_radius)}}},
        {settings.gather ? "all" : "others", {{"photons", photons.other_photons}, {"radius_first_last", radii(settings.radius)}}}};
    const PhotonPower& power = photons.power;
    for (std::size_t j = 0; j < power.went_on.size() && j <= bounces + 1; ++j) {
        Json vertex_json = {{"vertex", j}, {j == 0 ? "emitted" : "arrived", j == 0 ? power.went_on[0] : power.arrived[j]}};
        if (j > 0) vertex_json.update({{"absorbed", power.absorbed(j)}, {"went_on", power.went_on[j]}});
        vertex_json["escaped"] = power.escaped(j);
        json["power"].push_back(vertex_json);
    }
    return json;
}

Json records_json(const RecordPlaces& places) {
    std::vector<double> radii;
    for (const Record& record : places.records()) radii.push_back(record.radius);
    Json json = {{"number", radii.size()}, {"seen_by_camera", places.seen()}, {"rays_of_each", places.cells().size()}};
    if (!radii.empty()) {
        std::ranges::sort(radii);
        json["radius_least_median_largest"] = {radii.front(), radii[radii.size() / 2], radii.back()};
    }
    return json;
}

Json chains_json(const std::vector<ChainStatistics>& all) {
    Json json = Json::array();
    for (std::size_t bounce = 1; bounce < all.size(); ++bounce) {
        const ChainStatistics& c = all[bounce];
        const auto part = [](std::uint64_t n, std::uint64_t of) { return of == 0 ? Json() : Json(double(n) / double(of)); };
        json.push_back({{"bounce", bounce},
                        {"chains", c.chains},
                        {"states", c.states},
                        {"accepted_small_steps", part(c.small_accepted, c.small)},
                        {"accepted_large_steps", part(c.large_accepted, c.large)},
                        {"largest_stay", c.largest_stay},
                        {"autocorrelation_time", c.autocorrelation_time()}});
    }
    return json;
}

// For each method of a mixture its part of the work, and for each bounce its mean weight and a digit for each block of
// the picture, row by row: its weight from 0 to 1 in ninths.
Json mixture_json(const Mixture& mixture) {
    Json json = {{"blocks", {mixture.blocks.across, mixture.blocks.down}}, {"methods", Json::array()}};
    const std::size_t blocks = mixture.blocks.count();
    for (std::size_t part = 0; part < mixture.parts.size(); ++part) {
        std::vector<double> means(mixture.bounces, 0.0);
        std::vector<std::string> maps(mixture.bounces);
        for (std::size_t bounce = 0; bounce < mixture.bounces; ++bounce)
            for (std::size_t block = 0; block < blocks; ++block) {
                const double weight = mixture.weight(part, bounce, block);
                means[bounce] += weight / static_cast<double>(blocks);
                maps[bounce] += static_cast<char>('0' + std::lround(9.0 * weight));
            }
        json["methods"].push_back({{"method", mixture.parts[part].method},
                                   {"part_of_work", mixture.parts[part].share},
                                   {"mean_weight_of_bounces", means},
                                   {"weights_of_bounces", maps}});
    }
    return json;
}

Json samples_json(const BounceSeries& series) {
    Json json = {{"per_pixel", series.samples}};
    if (const auto* paths = std::get_if<PathRecord>(&series.record)) {
        json.update({{"replicate_size", paths->replicate_size}, {"replicates", paths->replicates}});
        if (paths->first_replicate > 0) json["first_replicate"] = paths->first_replicate;
        for (const SeedRange& range : paths->merged)
            json["merged"].push_back({{"seed", range.seed}, {"first_replicate", range.first}, {"replicates", range.count}});
        if (const auto* cache = as<CachePaths>(paths->path_method)) json["records"] = records_json(cache->records());
        if (const auto* photon = as<PhotonPaths>(paths->path_method))
            json["photons"] = photons_json(photon->pilot(), *paths, series.report.bounces.size() - 1);
        if (paths->most_of_pixel > 0)
            json["of_a_pixel_in_a_replicate"] = {{"fewest", paths->fewest_of_pixel}, {"most", paths->most_of_pixel}};
        if (const auto* walk = as<WalkPaths>(paths->path_method); walk && walk->tree()) {
            json["at_depths"] = {1.0};
            for (const double ratio : walk->tree()->of_depths)
                json["at_depths"].push_back(json["at_depths"].back().get<double>() * ratio);
        }
        if (const auto* mixed = as<MixedPaths>(paths->path_method)) json["mixture"] = mixture_json(mixed->mixture());
        if (!paths->chains.empty()) json["chains"] = chains_json(paths->chains);
        for (const auto& [albedo, walk] : paths->furnaces)
            json["walks_in_a_furnace"].push_back({{"albedo", albedo},
                                                  {"expected_vertices", walk.vertices},  // null if infinite
                                                  {"second_moment_of_sum", walk.second_moment}});
    } else {
        const auto& fields = std::get<FieldRecord>(series.record);
        json.update({{"replicates", fields.replicates},
                     {"patches", fields.patches},
                     {"unknowns", fields.unknowns},
                     {"directions", fields.directions}});
        if (!fields.why.empty()) json["why"] = fields.why;
        if (fields.gather_rays) json["gather_rays_per_sample"] = *fields.gather_rays;
    }
    json["degrees_of_freedom"] = series.degrees_of_freedom;
    json["outcome"] = name(series.outcome);
    return json;
}

}  // namespace

namespace {

Json choice_json(const MethodChoice& choice) {
    Json json = {{"method", name_of(choice.method)}, {"why", choice.why}};
    for (const MethodTrial& trial : choice.trials)
        json["pilot"].push_back({{"method", trial.method}, {"rays_per_sample", trial.rays}, {"error", json_number(trial.error)}});
    if (!choice.trials.empty()) json["pilot_seconds"] = choice.seconds;
    return json;
}

}  // namespace

Json options_json(const BounceSeries& series) {
    Json json = {{"bounces", series.bounces()}};
    json.update(as_json(series.method));
    json["seed"] = series.seed;
    return json;
}

Json run_json(const Rendering& rendering, const Warnings& warnings, const std::string& folder, double seconds_total) {
    const Scene& scene = *rendering.scene;
    const BounceSeries& series = rendering.series;
    const SeriesReport& report = series.report;
    Json json;
    json["program"] = {{"name", "neumann"}, {"version", NEUMANN_VERSION}, {"ray_caster", embree_version()}};
    json["command"] = rendering.request.command_line;
    json["request"] = as_json(render_options(), rendering.request);
    json["scene"] = scene_json(scene, rendering.request.scene);
    json["picture"] = {{"width", scene.film.crop_width}, {"height", scene.film.crop_height}};
    if (scene.film.crop_x != 0 || scene.film.crop_y != 0)
        json["picture"].update({{"crop_x", scene.film.crop_x}, {"crop_y", scene.film.crop_y}});
    json["quantity"] = report.importance ? Json{{"name", "importance K*^i We, mean over directions"}, {"unit", "m^-2 sr^-1"}}
                                         : Json{{"name", "radiance K^i Le"}, {"unit", "W m^-2 sr^-1"}};
    json["options"] = options_json(series);
    if (series.choice) json["choice"] = choice_json(*series.choice);
    json["files"] = names_of(rendering.files);
    json["plan"] = series.plan.parts.empty() ? Json("full") : plan_json(series.plan);
    json["paths"] = name(series.paths);
    json["samples"] = samples_json(series);
    json["timing"] = {
        {"sampling_seconds", series.seconds - series.setup_seconds}, {"total_seconds", seconds_total}, {"rays", series.rays}};
    if (series.setup_seconds > 0.0) json["timing"]["setup_seconds"] = series.setup_seconds;
    json["timing"]["seconds_of_bounces"] = Json::array();
    for (const BounceReport& b : report.bounces) json["timing"]["seconds_of_bounces"].push_back(b.seconds);
    if (rendering.processes > 1)
        json["processes"] = {
            {"count", rendering.processes}, {"messages", rendering.traffic.messages}, {"bytes", rendering.traffic.bytes}};
    json["sum"] = mean_json(report.sum, report.infinite_variance(), report.rare_large_samples());
    add_discretisation(json["sum"], report.sum_discretisation);
    json["bounces"] = Json::array();
    for (const BounceReport& b : report.bounces) {
        Json bounce = mean_json(b.mean, b.infinite_variance, b.rare_large_samples, b.unmet);
        add_discretisation(bounce, b.discretisation);
        if (b.missing) bounce["missing"] = mean_json(*b.missing, b.infinite_variance, b.rare_large_samples);
        if (b.ratio) bounce["ratio_estimate"] = *b.ratio;
        bounce["tail_bound"] = json_number(b.bound);
        if (b.tail) bounce["tail_index"] = {{"estimate", b.tail->alpha}, {"upper_99.9", b.tail->upper}};
        bounce["rays"] = b.rays;
        json["bounces"].push_back(bounce);
    }
    json["rest"] = rest_json(scene, series);
    if (series.ways) json["ways"] = as_json(*series.ways);
    json["health"] = health_json(series, scene, folder);
    json["warnings"] = Json::array();
    for (const auto& [text, count] : warnings.counts()) json["warnings"].push_back({{"text", text}, {"count", count}});
    return json;
}

}  // namespace neumann
