// Renders by sampling: walk and pointwise.
#include "apps/render_method.h"

#include "apps/interrupt.h"
#include "apps/method_options.h"
#include "apps/progress_line.h"
#include "core/base/error.h"
#include "core/base/memory.h"

#include <fmt/format.h>
#include <algorithm>
#include <bit>
#include <numeric>

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;

// Without any goal: a good picture, or what a short wait gives.
constexpr double default_seconds = 20.0, default_error = 0.02;

// Samples a pixel in one replicate: as many as still give several replicates.
std::uint32_t choose_replicate_size(const SamplingGoal& goal, const Film& film, const Pilot& pilot) {
    if (goal.samples) return replicate_size(*goal.samples);
    if (!goal.seconds) return largest_replicate;
    const double pixels = static_cast<double>(film.crop_width) * film.crop_height,
                 affordable = *goal.seconds / (pixels * pilot.seconds_per_walk());
    return std::bit_floor(static_cast<std::uint32_t>(std::clamp(affordable / 4.0, 1.0, static_cast<double>(largest_replicate))));
}

// What the moments of all pictures need at most: refused before the machine starts to swap.
void check_memory(const Film& film, int bounces) {
    const double nodes = 6.0;  // of the tree of replicates, at most, with the result
    const double bytes =
        nodes * film.crop_width * film.crop_height * (bounces + 2.0) * PixelMoments::doubles_per_quantity * sizeof(double);
    const double memory = physical_memory();
    if (bytes > 0.8 * memory)
        throw InputError(fmt::format(
            "{} bounces of {}×{} pixels need about {:.1f} GiB, the machine has {:.1f}; take fewer bounces or a smaller film",
            bounces, film.crop_width, film.crop_height, bytes / 0x1p30, memory / 0x1p30));
}

RestVerdict rest_verdict(const RenderJob& job) {
    if (job.request.method == "pointwise" || job.request.only_pictures) return RestVerdict::not_sampled;
    return job.pilot.converges() ? RestVerdict::measured : RestVerdict::not_converging;
}

BounceSeries bounce_series(const RenderedSeries& series, SeriesReport report) {
    BounceSeries out;
    const auto result = std::make_shared<SeriesMoments::Result>(series.moments.result());
    out.term = [result](std::size_t i) { return result->term(i); };
    out.sum = [result](std::size_t i) { return result->sum(i); };
    if (report.rest_verdict == RestVerdict::measured) out.rest = result->term(result->quantities() - 1);
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

RenderResult render_by_walk(const RenderJob& job) {
    const auto& [request, scene, pilot] = job;
    if (request.patches || request.directions)
        throw InputError(
            fmt::format("--patches and --directions belong to --method patches, matrix and gather, not to {}", request.method));
    if (request.method == "pointwise") {
        if (request.light.given()) throw InputError("--direct, --lights and --roulette belong to --method walk, not to pointwise");
        if (scene.emitters.has_delta_lights())
            throw InputError(
                "--method pointwise finds lights by chance, and no ray meets a light without extent (directional, point, "
                "projector, "
                "spot), of which the scene has some; take --method walk, matrix or gather");
    }
    PictureSampler::Settings settings;
    settings.method = request.method == "pointwise" ? Method::pointwise : Method::walk;
    settings.walk.bounces = choose_bounces(job);
    settings.walk.direct = direct_light(request.light, scene.emitters);
    settings.walk.roulette = roulette(request.light);
    settings.sampler = sampler_kind(request.sampler).value_or(scene.sampler.value_or(SamplerKind::sobol));
    settings.seed = request.seed;

    SamplingGoal goal{request.samples, request.seconds, request.relative_error};
    if (!goal.samples && !goal.seconds && !goal.relative_error) goal = {std::nullopt, default_seconds, default_error};
    settings.replicate_size = choose_replicate_size(goal, scene.film, pilot);

    RenderedSeries series{SeriesMoments(0, 0, 0), Tally(0), {}};
    SeriesReport report;
    const RestVerdict verdict = rest_verdict(job);
    for (;;) {
        const int N = settings.walk.bounces;
        check_memory(scene.film, N);
        settings.walk.rest_probability =
            verdict == RestVerdict::measured ? pilot.rest_probability(std::min(N, Pilot::bounces)) : 0.0;

        ProgressLine line(N, request.quiet);
        RenderObserver observer;
        observer.progress = [&](const RenderProgress& progress) { line.show(progress); };
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

    RenderResult result;
    result.series = bounce_series(series, std::move(report));
    Warnings& warnings = result.warnings;
    const auto& bsdfs = scene.materials.bsdfs();
    if (scene.emitters.has_delta_lights() &&
        std::any_of(bsdfs.begin(), bsdfs.end(), [](const Bsdf& b) { return lobe(b).kind == Lobe::Kind::specular; }))
        warnings.add("what a mirror throws on from a light without extent is not found by the walk and is missing");
    const double albedo = max_component(scene.materials.largest_basic_albedo());
    if (settings.walk.roulette.kind == Roulette::Kind::fixed && settings.walk.roulette.survival <= albedo * albedo)
        warnings.add(
            fmt::format("--roulette {}: where the albedo is above {:.3g}, the sums of walks have an infinite variance, and the "
                        "largest here is {:.3g}",
                        request.light.roulette, std::sqrt(settings.walk.roulette.survival), albedo));
    if (series.moments.replicates() < 2 && !request.only_pictures)
        warnings.add("a single replicate was sampled: the standard errors are unknown");
    warnings.add("sample was not a finite number and was left out", series.tally.non_finite_count);
    warnings.add(fmt::format("walk was given up {} bounces beyond the last picture", settings.walk.give_up), series.tally.given_up);
    if (result.series.report.infinite_variance())
        warnings.add("the variance of some bounces is infinite: their intervals do not hold");
    result.options = {{"bounces", settings.walk.bounces}, {"method", request.method}};
    if (request.method == "walk") result.options.update(as_json(request.light));
    result.options.update({{"sampler", settings.sampler == SamplerKind::sobol ? "sobol" : "independent"}, {"seed", settings.seed}});
    result.samples = {
        {"per_pixel", series.samples}, {"replicate_size", series.replicate_size}, {"replicates", series.moments.replicates()}};
    if (verdict == RestVerdict::measured)
        result.rest = {{"probability_of_being_sampled", settings.walk.rest_probability}, {"walks_given_up", series.tally.given_up}};
    if (verdict == RestVerdict::not_converging)
        result.rest["why"] = fmt::format("{} of {} walks had not ended after {} bounces and were given up", pilot.given_up(),
                                         pilot.walks(), Pilot::bounces + Pilot::give_up);
    result.non_finite = {{"count", series.tally.non_finite_count}, {"first", Json::array()}};
    for (const NonFiniteSample& s : series.tally.non_finite)
        result.non_finite["first"].push_back({{"x", s.x}, {"y", s.y}, {"bounce", s.bounce}, {"sample", s.sample}});
    return result;
}

}  // namespace neumann
