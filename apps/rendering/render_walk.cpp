// Renders by sampling: walk, guided, surface, classic and pointwise.
#include "apps/rendering/render_method.h"

#include "apps/commands/interrupt.h"
#include "apps/commands/limits.h"
#include "apps/files/health_json.h"
#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/base/stopwatch.h"
#include "operators/guide/direction_tables.h"
#include "operators/pictures/least_errors.h"
#include "operators/walk/furnace_walk.h"

#include <fmt/format.h>
#include <algorithm>
#include <bit>
#include <map>
#include <numeric>

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;

// Left to sampling where the set-up has taken all of the time, seconds.
constexpr double shortest_sampling = 1e-3;

// Samples a pixel in one replicate: as many as still give several replicates.
std::uint32_t choose_replicate_size(const SamplingGoal& goal, const Film& film, const Pilot& pilot, const Split& split) {
    if (goal.samples) return replicate_size(*goal.samples);
    if (!goal.seconds) return largest_replicate;
    const double pixels = static_cast<double>(film.crop_width) * film.crop_height,
                 seconds = pilot.seconds_per_walk() * std::max(split.lights, split.walks),
                 affordable = *goal.seconds / (pixels * seconds);
    return std::bit_floor(
        static_cast<std::uint32_t>(std::clamp(affordable / fewest_replicates, 1.0, static_cast<double>(largest_replicate))));
}

// What the moments of all pictures need at most: refused before the machine starts to swap.
void check_memory(const RenderRequest& request, const Film& film, int bounces) {
    const double nodes = 7.0;  // of the tree of replicates, at most, with the result and the samples' ranges
    const double bytes =
        nodes * film.crop_width * film.crop_height * (bounces + 2.0) * PixelMoments::doubles_per_quantity * sizeof(double);
    // All of it is known beforehand, so that it may be more than what grows by itself takes.
    const double memory = request.memory ? memory_limit(request.memory) : 0.8 * usable_memory();
    if (bytes > memory)
        throw InputError(
            fmt::format("{} bounces of {}×{} pixels need about {:.1f} GiB, and {:.1f} may be taken; take fewer bounces or a "
                        "smaller film",
                        bounces, film.crop_width, film.crop_height, bytes / 0x1p30, memory / 0x1p30));
}

Method method_of(const std::string& name) {
    static const std::map<std::string, Method> methods = {{"walk", Method::walk},
                                                          {"guided", Method::guided},
                                                          {"surface", Method::surface},
                                                          {"light", Method::light},
                                                          {"bidirectional", Method::bidirectional},
                                                          {"classic", Method::classic},
                                                          {"pointwise", Method::pointwise}};
    return methods.at(name);
}

std::optional<SamplerKind> sampler_kind(const std::string& name) {
    if (name.empty()) return std::nullopt;
    return name == "sobol" ? SamplerKind::sobol : SamplerKind::independent;
}

// How walks end, at the scene's largest albedo and at albedos near 1; what is infinite is printed as null.
Json as_json(const Roulette& roulette, double largest_albedo, int bounces) {
    Json furnaces = Json::array();
    for (const double albedo : {largest_albedo, 0.9, 0.99, 0.999}) {
        const FurnaceWalk walk = furnace_walk(roulette, albedo, bounces);
        furnaces.push_back(
            {{"albedo", albedo}, {"expected_vertices", walk.vertices}, {"second_moment_of_sum", walk.second_moment}});
    }
    return furnaces;
}

RestVerdict rest_verdict(const RenderJob& job) {
    if (job.request.method == "pointwise" || job.request.only_pictures) return RestVerdict::not_sampled;
    return job.pilot.converges() ? RestVerdict::measured : RestVerdict::not_converging;
}

BounceSeries bounce_series(const RenderedSeries& series, const std::shared_ptr<const SeriesMoments::Result>& result,
                           const std::shared_ptr<const LeastErrors>& least, SeriesReport report) {
    BounceSeries out;
    out.term = [result, least](std::size_t i) {
        PixelEstimate term = result->term(i);
        if (least) term.least_error = least->of_term(i);
        return term;
    };
    out.sum = [result, least](std::size_t i) {
        PixelEstimate sum = result->sum(i);
        if (least) sum.least_error = least->of_sum(i);
        return sum;
    };
    out.means_of_term = [result](std::size_t i) { return result->means_of_term(i); };
    out.means_of_sum = [result](std::size_t i) { return result->means_of_sum(i); };
    if (report.rest_verdict == RestVerdict::measured) {
        out.rest = out.term(result->quantities() - 1);
        out.means_of_rest = result->means_of_term(result->quantities() - 1);
    }
    out.report = std::move(report);
    out.convergence = series.convergence;
    out.outcome = series.outcome;
    out.samples = series.samples;
    out.rays = std::accumulate(series.tally.rays.begin(), series.tally.rays.end(), std::uint64_t{0});
    out.seconds = series.seconds;
    out.degrees_of_freedom = result->degrees_of_freedom();
    return out;
}

}  // namespace

SamplingSettings sampling_settings(const RenderRequest& request, const Scene& scene, const Plan& plan) {
    if (request.method != "guided" && (request.patches || request.directions))
        throw InputError(fmt::format("--patches and --directions belong to --method guided, patches, matrix and gather, not to {}",
                                     request.method));
    check_light_options(request.light, request.method);
    if (request.ways && request.method != "bidirectional")
        throw InputError("--ways belongs to --method bidirectional, not to " + request.method);
    SamplingSettings settings;
    settings.method = method_of(request.method);
    if (settings.method == Method::pointwise && scene.emitters.has_delta_lights())
        throw InputError(
            "--method pointwise finds lights by chance, and no ray meets a light without extent (directional, point, projector, "
            "spot), of which the scene has some; take --method walk, matrix or gather");
    if (scene.hide_emitters && splats(settings.method))
        throw InputError(fmt::format("--method {} cannot hide emitters, as the scene's integrator asks for; take --method walk",
                                     request.method));
    settings.walk.direct = direct_light(request.light, scene.emitters);
    // Neither finds lights by directions of its own, but in mirrors.
    if (settings.method == Method::surface || settings.method == Method::classic)
        settings.walk.direct = {.direct = DirectLight::light};
    settings.walk.roulette = roulette(request.light);
    settings.walk.split = split(request.light);
    settings.walk.left_out = plan.walk;
    settings.sampler = sampler_kind(request.sampler).value_or(scene.sampler.value_or(SamplerKind::sobol));
    settings.seed = request.seed;
    return settings;
}

std::shared_ptr<const DirectionTables> direction_tables(const RenderRequest& request, const Scene& scene, int bounces) {
    GuideSettings settings{.bounces = bounces, .seed = request.seed, .memory = memory_limit(request.memory)};
    if (request.patches) settings.patches = *request.patches;
    if (request.directions) {
        settings.rays = *request.directions;
        if (!std::has_single_bit(settings.rays) || settings.rays < CellDistribution::cells)
            throw InputError(fmt::format("--directions {}: --method guided expects a power of two, at least {}", settings.rays,
                                         CellDistribution::cells));
    }
    return std::make_shared<const DirectionTables>(scene, settings);
}

RenderResult render_by_walk(const RenderJob& job) {
    const auto& [request, scene, pilot, plan, progress, chosen] = job;
    PictureSampler::Settings settings = sampling_settings(request, scene, plan);
    const Paths paths = paths_of(settings.method, scene);
    settings.walk.bounces = choose_bounces(job);

    SamplingGoal goal{request.samples, request.seconds, request.relative_error};
    if (!goal.samples && !goal.seconds && !goal.relative_error) goal = {std::nullopt, default_seconds, default_error};
    double setup_seconds = 0.0;
    if (settings.method == Method::guided) {
        const Stopwatch watch;
        settings.tables = direction_tables(request, scene, settings.walk.bounces);
        setup_seconds = watch.seconds();
        // Of the time that was asked for.
        if (goal.seconds) goal.seconds = std::max(*goal.seconds - setup_seconds, shortest_sampling);
    }
    settings.replicate_size = choose_replicate_size(goal, scene.film, pilot, settings.walk.split);
    if (goal.relative_error && !goal.samples && !goal.seconds) goal.seconds = longest_search;

    RenderedSeries series{SeriesMoments(0, 0, 0), Tally(0), {}};
    SeriesReport report;
    const RestVerdict verdict = rest_verdict(job);
    for (;;) {
        const int N = settings.walk.bounces;
        check_memory(request, scene.film, N);
        settings.walk.rest_probability =
            verdict == RestVerdict::measured ? pilot.rest_probability(std::min(N, Pilot::bounces)) : 0.0;

        RenderObserver observer;
        observer.progress = [&](const RenderProgress& so_far) { job.progress(N, so_far); };
        observer.interrupted = interrupted;
        observer.checkpoints = !request.only_pictures;
        std::optional<Reference> reference;
        if (!request.reference.empty()) {
            reference.emplace(request.reference, N, scene.film);
            observer.judge = [&](const SeriesMoments::Result& result, Checkpoint& checkpoint) {
                reference->judge([&](std::size_t i) { return result.term(i).mean; }, result.sum(static_cast<std::size_t>(N)).mean,
                                 checkpoint);
            };
        }
        series = render_series(scene, settings, goal, observer);
        report = report_series(scene, series, verdict);
        // The pilot chose the bounces, the render judges them.
        if (!request.tail || request.bounces || interrupted() || verdict != RestVerdict::measured ||
            report.tail_fraction() <= *request.tail)
            break;
        settings.walk.bounces += std::max(1, N / 4);
        if (!request.quiet)
            fmt::print(stderr, "The rest is {:.3g} of the sum, more than {}: once more with {} bounces\n", report.tail_fraction(),
                       *request.tail, settings.walk.bounces);
    }

    if (paths != Paths::all) report_missing(report, pilot);

    RenderResult result;
    const auto moments = std::make_shared<const SeriesMoments::Result>(series.moments.result());
    std::shared_ptr<const LeastErrors> least;
    if (!request.only_pictures) {
        least = std::make_shared<const LeastErrors>(scene, settings, series, *moments);
        report_unmet(report, *least);
    }
    result.series = bounce_series(series, moments, least, std::move(report));
    result.series.paths = paths;
    Warnings& warnings = result.warnings;
    if (scene.emitters.has_delta_lights() && has_specular(scene.materials) && settings.method != Method::light)
        warnings.add(settings.method == Method::bidirectional
                         ? "what is seen in a mirror of a light without extent is not found from either end and is missing"
                         : "what a mirror throws on from a light without extent is not found by the walk and is missing");
    if (paths == Paths::seen_directly)
        warnings.add(
            "--method light makes no path whose last reflection before the camera is in a mirror, of glass or of anything else "
            "that "
            "sends light in a single direction, and does not see what surrounds the scene: these are missing");
    if (paths == Paths::specular)
        warnings.add(
            "--method classic makes only paths whose reflections are specular but for the last one: the light of all other "
            "paths is missing");
    if (paths == Paths::without_specular)
        warnings.add(
            "--method surface makes no path by way of a mirror, of glass or of anything else that sends light in a single "
            "direction: what these reflect and let through is missing");
    if (settings.method == Method::surface)
        warnings.add(
            "where surfaces meet at an angle, the variance of --method surface is infinite, even if the samples do not show it");
    const double albedo = max_component(scene.materials.largest_basic_albedo());
    if (settings.walk.roulette.kind == Roulette::Kind::fixed && settings.walk.roulette.survival <= albedo * albedo)
        warnings.add(
            fmt::format("--roulette {}: where the albedo is above {:.3g}, the sums of walks have an infinite variance, and the "
                        "largest here is {:.3g}",
                        request.light.roulette, std::sqrt(settings.walk.roulette.survival), albedo));
    if (series.moments.replicates() < 2 && !request.only_pictures)
        warnings.add("a single replicate was sampled: the standard errors are unknown");
    warnings.add(fmt::format("walk was given up {} bounces beyond the last picture", settings.walk.give_up), series.tally.given_up);
    if (result.series.report.infinite_variance())
        warnings.add("the variance of some bounces is infinite: their intervals do not hold");
    if (result.series.report.rare_large_samples())
        warnings.add(
            "the largest samples of some bounces are rare and make much of what is there: their intervals may be too short");
    if (request.relative_error && series.outcome == Outcome::time_reached) {
        const auto& errors = series.convergence.back().term_error;
        const auto worst = std::max_element(errors.begin(), errors.end());
        warnings.add(fmt::format("an error of {:g} was not reached in {:.0f} s: the largest is {:.2g}, in bounce {}",
                                 *request.relative_error, series.seconds, *worst, worst - errors.begin()));
    }
    if (request.ways) {
        check_memory(request, scene.film, 2 * *request.ways + 2);
        RenderObserver observer;
        observer.progress = [&](const RenderProgress& so_far) { job.progress(*request.ways, so_far); };
        observer.interrupted = interrupted;
        result.ways = render_ways(scene, settings, *request.ways, series.samples, observer);
    }
    result.options = {{"bounces", settings.walk.bounces}, {"method", request.method}};
    if (request.ways) result.options["ways"] = *request.ways;
    if (request.method == "walk" || request.method == "bidirectional") result.options.update(as_json(request.light));
    if (request.method == "light") result.options["roulette"] = request.light.roulette.empty() ? "none" : request.light.roulette;
    if (settings.tables) {
        result.options.update({{"patches", settings.tables->settings().patches}, {"directions", settings.tables->settings().rays}});
        result.series.setup_seconds = setup_seconds;
        result.series.seconds += setup_seconds;
        result.series.rays += settings.tables->rays();
        for (Checkpoint& checkpoint : result.series.convergence) checkpoint.seconds += setup_seconds;
    }
    result.options.update({{"sampler", settings.sampler == SamplerKind::sobol ? "sobol" : "independent"}, {"seed", settings.seed}});
    result.samples = {
        {"per_pixel", series.samples}, {"replicate_size", series.replicate_size}, {"replicates", series.moments.replicates()}};
    if (settings.method == Method::walk)
        result.samples["walks_in_a_furnace"] = as_json(settings.walk.roulette, albedo, settings.walk.bounces);
    if (verdict == RestVerdict::measured)
        result.rest = {{"probability_of_being_sampled", settings.walk.rest_probability}, {"walks_given_up", series.tally.given_up}};
    if (verdict == RestVerdict::not_converging)
        result.rest["why"] = fmt::format("{} of {} walks had not ended after {} bounces and were given up", pilot.given_up(),
                                         pilot.walks(), Pilot::bounces + Pilot::give_up);
    if (request.only_pictures) {
        warnings.add("sample was not a finite number and was left out", series.tally.non_finite_samples());
    } else {
        settings.replicate_size = series.replicate_size;  // smaller where it was interrupted
        result.health = [health = examine(scene, settings, series, *moments), &scene = job.scene](const std::string& folder) {
            return as_json(health, scene, folder);
        };
    }
    return result;
}

}  // namespace neumann
