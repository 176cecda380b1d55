#include "apps/commands/render_command.h"

#include "apps/commands/preview.h"
#include "apps/commands/print_rendering.h"
#include "apps/commands/progress_line.h"
#include "apps/live/live_page.h"
#include "apps/live/page_so_far.h"
#include "apps/live/tev_viewer.h"
#include "apps/output/files/checkpoints.h"
#include "apps/output/files/json_text.h"
#include "apps/output/files/recorded_run.h"
#include "apps/output/files/reference.h"
#include "apps/output/files/request_json.h"
#include "apps/output/files/saved_render.h"
#include "apps/output/files/scene_json.h"
#include "apps/output/files/series_files.h"
#include "apps/processes/launch.h"
#include "core/base/error.h"
#include "core/base/interrupt.h"
#include "core/base/limits.h"
#include "core/base/stopwatch.h"
#include "core/image/image_io.h"
#include "operators/render/from_paths/rendered_series.h"
#include "operators/render/methods/render.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>

namespace neumann {

namespace {

constexpr double large_folder = 200e6;  // bytes; larger folders are announced before they are written
constexpr int rest_of_files = 50;       // a page in the folder that nobody asked for takes a fiftieth of the time

// A viewer for index.html, once the render has taken long enough for it, and only if it replaces no finished page.
Viewers viewers_of_files(const Scene& scene, const OutputFolder& folder, const ChosenFiles& files, std::optional<int> bounces,
                         PageSoFar& page) {
    constexpr int about_so_many = 8;
    constexpr double shortest = 10.0;
    const double pixels = static_cast<double>(scene.film.crop_width) * scene.film.crop_height;
    const double pictures = bounces.value_or(scene.bounces.value_or(about_so_many)) + 2.0;
    const std::chrono::duration<double> first(std::max(shortest, rest_of_files * PageSoFar::expected_seconds(pixels, pictures)));
    Viewers viewers{{}, SmallShare(rest_of_files, first)};
    if (files.page && folder.may_show_page()) viewers.all.push_back(&page);
    return viewers;
}

void expect_paths(const Method& method) {
    if (const auto* chosen = std::get_if<method::Auto>(&method); chosen && chosen->bias_allowed)
        throw OptionError("paths", ": --bias-allowed may choose fields on patches, which have no paths; take one of the two");
    if (const std::string why = why_no_replay(method); !why.empty())
        throw OptionError("paths", fmt::format(": {} has no paths to replay: {}", name_of(method), why));
}

void expect_nothing_unfinished(const std::string& folder) {
    if (std::filesystem::exists(std::filesystem::path(folder) / unfinished_render_file))
        throw InputError(
            fmt::format("{0}: holds a render that was not finished; neumann render --resume {0} goes on with it, and to "
                        "begin another one there, remove {1}",
                        folder, unfinished_render_file));
}

// The state from which the render continues, if any.
std::optional<RenderState> read_state(const RenderRequest& request, const Scene& scene,
                                      const std::function<void(const std::string&)>& tell) {
    if (request.resume.empty()) return std::nullopt;
    if (scene.hash != request_in(request.resume).scene_hash)
        throw OptionError("resume", fmt::format("{}: {} is not the scene that it began with, or has changed since", request.resume,
                                                request.scene.path));
    const auto file = saved_render_in(request.resume);
    if (!file) return std::nullopt;
    RenderState state = read_saved_render(*file);
    if (state.fields) return state;
    if (!state.series.merged.empty())
        throw OptionError("resume",
                          fmt::format("{}: was merged of several seeds; render another seed and merge that, too", request.resume));
    const std::uint64_t there = state.series.samples;
    const SeriesMoments& moments = state.series.moments;
    if (moments.width() != scene.film.crop_width || moments.height() != scene.film.crop_height)
        throw InputError(fmt::format("{}: damaged: its pictures have another size", file->string()));
    if (const auto& samples = request.goal.samples) {
        const std::uint64_t whole = in_whole_replicates(*samples);
        if (whole < there)
            throw OptionError("spp", fmt::format("{}: {} has {} samples a pixel already", *samples, request.resume, there));
        if (const std::uint32_t wanted = replicate_size(whole); wanted != state.render.replicate_size) {
            tell(fmt::format(
                "The {} samples a pixel of {} are in replicates of {}, and {} are better in replicates of {}: it begins anew",
                there, request.resume, state.render.replicate_size, whole, wanted));
            return std::nullopt;
        }
    }
    return state;
}

}  // namespace

Viewers chosen_viewers(std::vector<Viewer*> all) {
    constexpr int rest = 20;  // at most a twentieth of the time
    constexpr double longest_unseen = 2.0;
    return {std::move(all), SmallShare(rest), longest_unseen};
}

std::shared_ptr<Rendering> render(const RenderRequest& request, std::shared_ptr<const Scene> scene, const Watch& given,
                                  Saving saving, Viewers* viewers) {
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
    const auto as_rendering = [&](BounceSeries series) {
        return Rendering{request, scene, std::move(series), clock.seconds(), choose_files(request.files, request.theme == "white")};
    };
    if (viewers && !viewers->all.empty()) {
        saving.longest_part = std::min(saving.longest_part, viewers->longest_unseen);
        saving.see = [&](const std::function<BounceSeries()>& so_far) {
            if (!viewers->share.is_due()) return;
            viewers->share.spend([&] {
                const Rendering rendering = as_rendering(so_far());
                for (Viewer* const viewer : viewers->all) viewer->see(rendering);
            });
        };
    }
    BounceSeries series = render(*scene, make_method(request.method), goal, watch, std::move(saving));
    if (reference) warn_of_reference(request.reference, series, series.warnings);
    return std::make_shared<Rendering>(as_rendering(std::move(series)));
}

int render_command(const RenderRequest& given) {
    RenderRequest request = given;
    if (request.touch) request.files.emplace_back("touch");
    // This throws for options that exclude each other, before the scene is read.
    const bool fields = has_fields(make_method(request.method));
    if (request.goal.part && (fields || !request.goal.samples))
        throw InputError(fields ? fmt::format("--part: {} has no samples that could be put together", request.method.name)
                                : std::string("--part needs --spp, the samples of all parts"));
    const ChosenFiles files = choose_files(request.files, request.theme == "white");
    const ChosenPixels paths = choose_pixels(request.paths, files);
    if (!paths.empty()) expect_paths(make_method(request.method));
    if (request.output.empty())
        request.output = (std::filesystem::path("out") / std::filesystem::path(request.scene.path).stem()).string();
    std::error_code missing;
    if (!request.reference.empty() && std::filesystem::equivalent(request.reference, request.output, missing))
        throw InputError(fmt::format("-o {}: is the reference, which would be lost; expected another folder", request.output));
    if (request.resume.empty()) expect_nothing_unfinished(request.output);
    const Stopwatch clock;
    std::optional<LivePage> live;
    if (request.live) {
        live.emplace(*request.live);
        live->announce(std::filesystem::path(request.scene.path).filename().string());
        if (!request.quiet) fmt::print(stderr, "The page of this render, which fills meanwhile: {}\n", live->address());
        live->open();
    }
    Watch watch;
    watch.stop = interrupted;
    watch.tell = [&](const std::string& text) {
        if (!request.quiet) fmt::print(stderr, "{}\n", text);
    };
    std::optional<TevViewer> tev;
    if (!request.tev.empty()) tev.emplace(request.tev, request.output, watch.tell);
    const ThreadLimit threads(threads_of_process(request.threads));

    const auto scene = std::make_shared<const Scene>(read_scene(request.scene));
    for (const Vec2& p : paths.pixels) pixel_number(scene->film, static_cast<int>(p.x), static_cast<int>(p.y), "--paths");
    // Before the render, which must not be lost because a scene cannot be touched.
    const auto separated = files.touch ? std::make_shared<const SeparatedScene>(separate(*scene, {}, watch)) : nullptr;
    catch_interrupts();  // only now, because nothing was written before
    std::optional<OutputFolder> folder(std::in_place, request.output, "render");
    std::optional<RenderState> state = read_state(request, *scene, watch.tell);
    const auto crew = launched_crew(request.scene, *scene, request.threads);
    const double reading_seconds = clock.seconds();
    ProgressLine line(request.quiet);
    watch.crew = crew.get();
    Preview preview(*folder, lenient_label(*scene), [&](std::string png) {
        if (live) live->preview(std::move(png));
    });
    watch.progress = [&](const RenderProgress& so_far) {
        if (live) live->tell(so_far);
        line.show([&] { return progress_text(so_far) + (preview.is_there() ? "   so far: preview.png" : ""); });
    };
    if (files.sheets || files.strips) watch.show = [&](std::size_t bounces, const auto& term) { preview.show(bounces, term); };
    watch.chosen = [&](int bounces) {
        expect_pictures();  // fails before anything is sampled
        const double bytes = estimated_bytes(scene->film, bounces, is_biased(make_method(request.method)), files);
        folder->expect_space(bytes);
        if (bytes > large_folder)
            watch.tell(
                fmt::format("The pictures of bounces 0 to {} will take up to {:.0f} MB in {}; fewer with -n, a smaller film, or "
                            "--files",
                            bounces, bytes * 1e-6, request.output));
    };
    Checkpoints checkpoints(*folder, {as_json(render_options(), request), scene->hash}, "neumann render --resume " + request.output,
                            request.checkpoint, !request.resume.empty() || request.goal.part, watch.tell);
    PageSoFar page_so_far(*folder);
    Viewers viewers =
        live || tev ? chosen_viewers({}) : viewers_of_files(*scene, *folder, files, request.goal.bounces, page_so_far);
    if (live) viewers.all.push_back(&*live);
    if (tev) viewers.all.push_back(&*tev);
    const auto rendering = [&] {
        try {
            return render(request, scene, watch, checkpoints.saving(std::move(state)), &viewers);
        } catch (const Stopped& error) {
            if (!std::filesystem::exists(folder->saved())) throw;
            throw RunError(fmt::format("{}; neumann render --resume {} goes on", error.what(), request.output));
        }
    }();
    line.clear();
    rendering->seconds += reading_seconds;
    rendering->paths = paths;
    rendering->separated = separated;
    if (const Processes* const processes = launched()) {
        rendering->processes = processes->size();
        rendering->traffic = processes->traffic();
    }
    const auto [warnings, json, page, why_no_paths] = [&] {
        try {
            return write_rendering(*rendering, *folder);
        } catch (const RunError& error) {
            folder.reset();
            throw RunError(fmt::format("{}\n{}", error.what(), keep_elsewhere(*rendering, request.output)));
        }
    }();

    if (!why_no_paths.empty() && !request.quiet) fmt::print(stderr, "note: the page has no paths: {}\n", why_no_paths);
    if (request.json) {
        if (!request.quiet) print_problems(*rendering, warnings, request.output);
        fmt::print("{}\n", json_text(json, 2));
    } else if (!request.quiet) {
        print_rendering(*rendering, warnings, request.output);
    }
    if (tev) tev->see(*rendering);
    if (live) {
        std::fflush(stdout);
        const auto file = std::filesystem::absolute(std::filesystem::path(request.output) / "index.html").lexically_normal();
        page.empty() ? live->finish(page_data(*rendering, false), "") : live->finish(page, file.string());
    }
    return 0;
}

}  // namespace neumann
