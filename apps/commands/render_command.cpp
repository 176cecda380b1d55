#include "apps/commands/render_command.h"

#include "apps/commands/checkpoints.h"
#include "apps/commands/interrupt.h"
#include "apps/commands/limits.h"
#include "apps/commands/parse_definitions.h"
#include "apps/commands/preview.h"
#include "apps/commands/progress_line.h"
#include "apps/files/reference.h"
#include "apps/files/saved_render.h"
#include "apps/files/scene_json.h"
#include "apps/files/series_files.h"
#include "apps/files/ways_files.h"
#include "core/base/error.h"
#include "core/base/stopwatch.h"
#include "core/image/image_io.h"
#include "core/reader/read_scene.h"
#include "operators/methods/render.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace neumann {

namespace {

std::string interval(const MeanWithError& mean, bool infinite_variance, bool rare_large_samples = false, bool unmet = false) {
    if (unmet) return std::isfinite(mean.interval()) ? fmt::format("< {:.2g}", mean.interval()) : "no sample met it";
    if (infinite_variance) return "infinite variance";
    return fmt::format("± {:.2g}{}", mean.interval(), rare_large_samples ? " at least" : "");
}

void print_summary(const BounceSeries& series, const std::string& folder) {
    const SeriesReport& report = series.report;
    const bool discretised = report.sum_discretisation.has_value();
    const auto patches = [&](const std::optional<DiscretisationReport>& d) {
        return d ? fmt::format("  {:>9.2g}  {:>9.2g}", d->mean, d->worst) : std::string();
    };
    const bool subset = series.paths != Paths::all;
    fmt::print("{:>6}  {:>12}  {:<18}  {:>8}  {:>10}{}{}\n", "bounce", "mean", "95% interval", "ratio", "tail bound",
               discretised ? "  discretisation: mean, worst" : "", subset ? "  missing" : "");
    for (std::size_t i = 0; i < report.bounces.size(); ++i) {
        const BounceReport& b = report.bounces[i];
        fmt::print(
            "{:>6}  {:>12.6g}  {:<18}  {:>8}  {:>10}{}{}\n", i, b.mean.mean,
            interval(b.mean, b.infinite_variance, b.rare_large_samples, b.unmet), b.ratio ? fmt::format("{:.4f}", *b.ratio) : "",
            std::isfinite(b.bound) ? fmt::format("{:.3g}", b.bound) : "none", patches(b.discretisation),
            b.missing ? fmt::format("  {:.3g} {}", b.missing->mean, interval(*b.missing, b.infinite_variance, b.rare_large_samples))
                      : "");
    }
    fmt::print("{:>6}  {:>12.6g}  {:<18}{:>22}{}\n", "sum", report.sum.mean,
               interval(report.sum, report.infinite_variance(), report.rare_large_samples()), "",
               patches(report.sum_discretisation));
    switch (report.rest_verdict) {
        case RestVerdict::measured:
            fmt::print("{:>6}  {:>12.6g}  {:<18}  measured: {}\n", "rest", report.rest.mean,
                       interval(report.rest, report.rest_infinite_variance, report.rest_rare_large_samples, report.rest_unmet),
                       std::isfinite(report.tail_fraction())
                           ? fmt::format("with its interval {:.2g} of the sum", report.tail_fraction())
                           : "no sample met any light");
            break;
        case RestVerdict::not_converging:
            fmt::print("{:>6}  not converging: {}\n", "rest",
                       discretised ? "the terms do not fall, or too slowly to add them up" : "walks did not end and were given up");
            break;
        case RestVerdict::not_sampled:
            break;
    }
    const auto unmet = [](const BounceReport& b) { return b.unmet; };
    if (report.rest_unmet || std::any_of(report.bounces.begin(), report.bounces.end(), unmet))
        fmt::print("Where the interval is an upper bound, no sample met anything; what is known to be 0 is ± 0.\n");
    if (report.importance) fmt::print("These are importance, in m⁻²·sr⁻¹, not radiance.\n");
    if (subset)
        fmt::print("These are some of all paths. What is missing of a bounce is its mean over walks of all paths, less this.\n");
    if (report.infinite_variance())
        fmt::print(
            "The largest samples show that the variance is infinite: no interval holds there, and more samples help little.\n");
    if (report.rare_large_samples() || report.rest_rare_large_samples)
        fmt::print(
            "At least: the variance is finite, but the largest samples are rare and make much of what is there. The interval may "
            "be\n"
            "too short; more samples help, or another method.\n");
    if (series.choice) fmt::print("By method {}: {}.\n", name_of(series.choice->method), series.choice->why);
    if (series.outcome == Outcome::interrupted) fmt::print("Interrupted: the pictures hold what was sampled so far.\n");
    fmt::print("{} samples a pixel in {:.1f} s. The pictures are in {}\n", series.samples, series.seconds, folder);
}

void expect_nothing_unfinished(const std::string& folder) {
    if (std::filesystem::exists(std::filesystem::path(folder) / unfinished_render_file))
        throw InputError(
            fmt::format("{0}: holds a render that was not finished; neumann render --resume {0} goes on with it, and to "
                        "begin another one there, remove {1}",
                        folder, unfinished_render_file));
}

// What is there already, and can be gone on with to the goal.
std::optional<RenderState> read_state(const RenderRequest& request, const Scene& scene) {
    if (request.resume.empty()) return std::nullopt;
    if (scene.hash != request.scene_hash)
        throw InputError(fmt::format("--resume {}: {} is not the scene that it began with, or has changed since", request.resume,
                                     request.scene));
    const auto file = saved_render_in(request.resume);
    if (!file) return std::nullopt;
    RenderState state = read_saved_render(*file);
    const std::uint64_t there = state.series.samples, size = state.render.replicate_size;
    const SeriesMoments& moments = state.series.moments;
    if (moments.width() != scene.film.crop_width || moments.height() != scene.film.crop_height)
        throw InputError(fmt::format("{}: damaged: its pictures have another size", file->string()));
    if (const auto& samples = request.goal.samples) {
        if (*samples < there)
            throw InputError(fmt::format("--spp {}: {} has {} samples a pixel already", *samples, request.resume, there));
        if (*samples % size != 0)
            throw InputError(fmt::format("--spp {}: {} samples {} at once for each pixel, expected a multiple of that", *samples,
                                         request.resume, size));
    }
    return state;
}

}  // namespace

std::shared_ptr<Rendering> render(const RenderRequest& request, std::shared_ptr<const Scene> scene, const Watch& given,
                                  Saving saving) {
    const Stopwatch clock;
    Goal goal = request.goal;
    if (request.memory) goal.memory = memory_limit(request.memory);
    Watch watch = given;
    std::optional<Reference> reference;
    if (!request.reference.empty()) {
        watch.chosen = [&](int bounces) {
            given.chosen(bounces);
            reference.emplace(request.reference, bounces, scene->film);
        };
        watch.judge = [&](const auto& term, const Image& sum, Checkpoint& checkpoint) { reference->judge(term, sum, checkpoint); };
    }
    BounceSeries series = render(*scene, make_method(request.method), goal, watch, std::move(saving));
    if (reference) warn_of_reference(request.reference, series, series.warnings);
    return std::make_shared<Rendering>(Rendering{request.scene, request.command_line, request.options, request.definitions,
                                                 std::move(scene), std::move(series), clock.seconds(),
                                                 choose_files(request.files)});
}

int render_command(const RenderRequest& given) {
    RenderRequest request = given;
    request.definitions = parse_definitions(request.definition_texts);
    const bool fields = has_fields(make_method(request.method));  // refuses what does not go together, before the scene is read
    const ChosenFiles files = choose_files(request.files);
    if (request.output.empty())
        request.output = (std::filesystem::path("out") / std::filesystem::path(request.scene).stem()).string();
    std::error_code missing;
    if (!request.reference.empty() && std::filesystem::equivalent(request.reference, request.output, missing))
        throw InputError(fmt::format("-o {}: is the reference, which would be lost; expected another folder", request.output));
    if (request.resume.empty()) expect_nothing_unfinished(request.output);
    const Stopwatch clock;
    catch_interrupts();
    const ThreadLimit threads(request.threads);

    const auto scene = std::make_shared<const Scene>(read_scene(request.scene, request.definitions, {.lenient = request.lenient}));
    std::optional<OutputFolder> folder(std::in_place, request.output, "render");
    std::optional<RenderState> state = read_state(request, *scene);
    const double reading_seconds = clock.seconds();
    ProgressLine line(request.quiet);
    Watch watch;
    watch.stop = interrupted;
    Preview preview(*folder, lenient_label(*scene));
    watch.progress = [&](const RenderProgress& so_far) {
        line.show([&] { return progress_text(so_far) + (preview.is_there() ? "   so far: preview.png" : ""); });
    };
    if (files.sheets || files.strips) watch.show = [&](std::size_t bounces, const auto& term) { preview.show(bounces, term); };
    watch.chosen = [&](int bounces) {
        expect_pictures();  // before anything is sampled
        folder->expect_space(estimated_bytes(scene->film, bounces, fields, files));
    };
    watch.tell = [&](const std::string& text) {
        if (!request.quiet) fmt::print(stderr, "{}\n", text);
    };
    Checkpoints checkpoints(*folder, {request.options, scene->hash}, request.checkpoint, !request.resume.empty());
    Saving saving{std::move(state), {}, 0.5 * request.checkpoint};
    saving.keep = [&](const auto&... so_far) { checkpoints.keep(so_far...); };
    const auto rendering = render(request, scene, watch, std::move(saving));
    line.clear();
    rendering->seconds += reading_seconds;
    const auto [warnings, json] = [&] {
        try {
            return write_rendering(*rendering, *folder);
        } catch (const RunError& error) {
            folder.reset();
            throw RunError(fmt::format("{}\n{}", error.what(), keep_elsewhere(*rendering, request.output)));
        }
    }();

    if (!request.quiet)
        for (const auto& [text, count] : warnings.counts())
            fmt::print(stderr, "warning: {}{}\n", text, count > 1 ? fmt::format(" ({} times)", count) : "");
    if (!request.quiet)
        for (const std::string& complaint : rendering->complaints(request.output)) fmt::print(stderr, "sick: {}\n", complaint);
    const BounceSeries& series = rendering->series;
    if (request.json)
        fmt::print("{}\n", json.dump(2));
    else if (!request.quiet)
        print_summary(series, request.output);
    if (series.ways && !request.json && !request.quiet) fmt::print("{}", ways_table(*series.ways));
    return 0;
}

}  // namespace neumann
