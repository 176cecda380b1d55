#include "apps/commands/merge_command.h"

#include "apps/commands/print_rendering.h"
#include "apps/output/files/json_text.h"
#include "apps/output/files/request_json.h"
#include "apps/output/files/saved_render.h"
#include "apps/output/rendering_files.h"
#include "core/base/error.h"
#include "core/base/limits.h"
#include "core/base/stopwatch.h"
#include "operators/render/methods/merge.h"
#include "operators/render/methods/render.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>

namespace neumann {

namespace {

NamedState read(const std::string& folder) {
    const std::filesystem::path file = std::filesystem::path(folder) / samples_file;
    if (!std::filesystem::is_directory(folder)) throw InputError(folder + ": is not a folder; expected that of a finished render");
    if (std::filesystem::exists(std::filesystem::path(folder) / unfinished_render_file))
        throw InputError(
            fmt::format("{0}: holds a render that was not finished; neumann render --resume {0} goes on with it", folder));
    if (!std::filesystem::exists(file))
        throw InputError(
            fmt::format("{}: holds no {}; renders that are to be merged keep it with --part, or with a --checkpoint shorter "
                        "than they take",
                        folder, samples_file));
    NamedState state{folder, read_saved_render(file)};
    if (state.state.fields)
        throw InputError(folder + ": was rendered from fields on patches, and has no samples that could be put together");
    return state;
}

// The samples a pixel that are missing because a part is not here or was cut short.
std::uint64_t missing_samples(const Goal& goal, const RenderState& merged) {
    if (!goal.part) return 0;
    const std::uint64_t all = goal.samples.value();
    std::map<std::uint64_t, std::uint64_t> of_seed;
    for (const SeedRange& range : merged.series.merged) of_seed[range.seed] += range.count * merged.render.replicate_size;
    if (of_seed.empty()) of_seed[merged.render.seed] = merged.series.samples;
    std::uint64_t missing = 0;
    for (const auto& [seed, samples] : of_seed) missing += samples < all ? all - samples : 0;
    return missing;
}

}  // namespace

RenderRequest request_for_all(RenderRequest of_some, const RenderState& merged) {
    const bool one_seed = merged.series.merged.empty();
    of_some.goal.part.reset();
    of_some.goal.samples = one_seed ? std::optional(merged.series.samples) : std::nullopt;
    of_some.goal.seed = one_seed ? merged.render.seed : 0;
    of_some.paths.clear();
    return of_some;
}

int merge_command(const MergeRequest& request) {
    const Stopwatch clock;
    for (const std::string& folder : request.folders)
        if (std::error_code missing; std::filesystem::equivalent(folder, request.output, missing))
            throw InputError(fmt::format("-o {}: is one of those that are merged; expected another folder", request.output));
    std::vector<NamedState> renders;
    std::vector<RequestOnDisk> requests;
    for (const std::string& folder : request.folders) {
        renders.push_back(read(folder));
        requests.push_back(request_in(folder));
        if (requests.back().scene_hash != requests.front().scene_hash)
            throw InputError(
                fmt::format("{} and {} cannot be merged: their scenes are not the same", request.folders.front(), folder));
    }
    RenderState merged = merge(std::move(renders));

    RenderRequest all = request_from_json(render_options(), requests.front().request, request.folders.front());
    const std::uint64_t missing = missing_samples(all.goal, merged);
    const ThreadLimit threads(request.threads);
    all = request_for_all(std::move(all), merged);
    all.scene.path = request.scene.empty() ? file_named_in_json(all.scene.path) : request.scene;
    all.command_line = request.command_line;
    const auto scene = std::make_shared<const Scene>(read_scene(all.scene));
    if (scene->hash != requests.front().scene_hash)
        throw InputError(fmt::format("{}: is not the scene that was rendered, or has changed since", all.scene.path));

    OutputFolder folder(request.output, "render");
    const RequestOnDisk together{as_json(render_options(), all), scene->hash};
    save_render(folder, together, merged.render, merged.choice, merged.series);
    Goal goal;
    goal.samples = merged.series.samples;
    const Method method = merged.render.method;
    Saving saving;
    saving.from = std::move(merged);
    BounceSeries series = render(*scene, method, goal, {}, std::move(saving));
    if (missing > 0)
        series.warnings.add(
            fmt::format("{} samples a pixel of the whole are missing: a part is not here, or was cut short", missing));
    const Rendering rendering{all, scene, std::move(series), clock.seconds(),
                              choose_files(request.files, request.theme == "white")};
    const auto [warnings, json, page, why_no_paths] = write_rendering(rendering, folder);
    if (!request.quiet) print_rendering(rendering, warnings, request.output);
    return 0;
}

}  // namespace neumann
