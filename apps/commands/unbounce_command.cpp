#include "apps/commands/unbounce_command.h"

#include "apps/commands/print_warnings.h"
#include "apps/commands/progress_line.h"
#include "apps/output/files/json_text.h"
#include "apps/output/files/scene_json.h"
#include "apps/output/files/unbounce_files.h"
#include "core/base/error.h"
#include "core/base/interrupt.h"
#include "core/base/limits.h"
#include "core/image/image_io.h"
#include "core/reader/read_scene.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

namespace neumann {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Blocks = std::pair<int, int>;

constexpr int default_width = 64;
constexpr Blocks default_blocks{8, 8};

std::optional<Blocks> blocks_of(const std::optional<std::string>& text) {
    if (!text) return std::nullopt;
    Blocks blocks{0, 0};
    const char* const end = text->data() + text->size();
    const auto columns = std::from_chars(text->data(), end, blocks.first);
    if (columns.ec == std::errc() && columns.ptr != end && *columns.ptr == 'x')
        if (const auto rows = std::from_chars(columns.ptr + 1, end, blocks.second); rows.ec == std::errc() && rows.ptr == end)
            if (blocks.first > 0 && blocks.second > 0 && blocks.first * std::int64_t{blocks.second} > 1) return blocks;
    throw OptionError("lights", fmt::format("{}: expected COLUMNSxROWS of at least two lights, such as 8x8", *text));
}

// The pictures to unbounce, and their renders if they were rendered.
struct Input {
    LightPictures pictures;
    Regions regions;
    std::vector<Estimate> forward;
    std::optional<Blocks> blocks;
    std::optional<LightRenders> renders;
    Json json;  // where the pictures come from

    Input() = default;
    Input(const Input&) = delete;  // pictures may refer to renders
};

void read_input(const UnbounceRequest& request, Input& input) {
    const LightFolder folder = read_light_folder(request.input.path);
    for (const std::string& light : folder.lights) input.pictures.names.push_back(fs::path(light).filename().string());
    input.pictures.picture = [files = folder.lights](std::size_t j) { return read_light(files[j]); };
    if (!folder.direct.empty()) input.pictures.direct = [files = folder.direct](std::size_t j) { return read_light(files[j]); };
    for (const std::string& file : folder.forward) input.forward.push_back(read_light(file));
    if (!request.picture.empty()) input.forward.clear();  // the forward series is for all lights
    const auto given = blocks_of(request.lights);
    input.blocks = given ? given : folder.blocks;
    const std::size_t lights = folder.lights.size();
    if (given && static_cast<std::size_t>(given->first) * static_cast<std::size_t>(given->second) != lights)
        throw OptionError("lights", fmt::format("{}: {} has {} pictures", *request.lights, request.input.path, lights));
    if (lights > 1 && !request.regions.empty()) {
        input.regions = read_regions(request.regions);
    } else if (lights > 1 && folder.blocks) {
        const Image first = input.pictures.picture(0).mean;
        input.regions = block_regions(first.width, first.height, folder.blocks->first, folder.blocks->second);
    } else if (lights > 1) {
        input.regions = brightest_regions(input.pictures);
    }
    input.json = {{"folder", request.input.path}};
    if (!request.regions.empty()) input.json["regions"] = request.regions;
    if (!request.picture.empty()) input.json["picture"] = request.picture;
}

Scene scene_of(const UnbounceRequest& request) {
    if (!request.picture.empty() || !request.regions.empty())
        throw InputError(fmt::format("--{} is for a folder of pictures, and {} is not a folder",
                                     request.picture.empty() ? "regions" : "picture", request.input.path));
    return read_scene(request.input);
}

void render_input(const UnbounceRequest& request, const Scene& scene, const Watch& watch, ProgressLine& line, Input& input) {
    const Blocks blocks = blocks_of(request.lights).value_or(default_blocks);
    print_warnings(scene.replaced, request.quiet);
    const int width = request.width > 0 ? request.width : std::max(std::min(scene.film.width, default_width), blocks.first);
    const ProjectorLights projector(scene, width, blocks.first, blocks.second);
    expect_pictures();  // fails before anything is sampled
    input.renders = render_lights(projector, {request.bounces, request.samples, request.seed}, watch, [&](double done) {
        line.show([&] { return fmt::format("{:.0f}% of the samples under {} lights", 100.0 * done, projector.lights()); });
    });
    LightRenders& renders = *input.renders;
    for (std::size_t j = 0; j < projector.lights(); ++j) input.pictures.names.push_back(fmt::format("light_{:03}.exr", j));
    input.pictures.picture = [&renders](std::size_t j) { return renders.pictures[j]; };
    input.pictures.direct = [&renders](std::size_t j) { return renders.direct_of(j); };
    input.pictures.parts = &renders.parts;
    input.regions = renders.parts.regions;
    input.forward = renders.forward;
    input.blocks = blocks;
    input.json = {{"scene", scene_json(scene, request.input)},
                  {"blocks", {blocks.first, blocks.second}},
                  {"spp", request.samples},
                  {"seed", request.seed},
                  {"seconds", renders.seconds},
                  {"warnings", texts(renders.warnings)}};
}

std::string with_error(const MeanWithError& mean, bool is_known) {
    return is_known ? fmt::format("{:.5g} ± {:.2g}", mean.mean, mean.standard_error) : fmt::format("{:.5g}", mean.mean);
}

void print(const Unbounced& found, const std::vector<TermAgreement>& forward, const std::vector<Doubt>& doubts,
           const std::string& output) {
    constexpr const char* names[] = {"red", "green", "blue"};
    fmt::print("{:<8}{:>8}{:>12}{:>22}{:>12}{:>16}{:>24}\n", "", "lights", "condition", "least singular value", "noise",
               "regularisation", "Bai's series by bounce");
    for (std::size_t c = 0; c < 3; ++c) {
        const UnbouncedChannel& channel = found.channels[c];
        if (channel.lights.empty()) {
            fmt::print("{:<8}{:>8}  black\n", names[c], 0);
            continue;
        }
        const Conditioning& conditioning = channel.conditioning;
        fmt::print("{:<8}{:>8}{:>12.3g}{:>22.3g}{:>12}{:>16.3g}{:>15.3g}{}\n", names[c], channel.lights.size(),
                   conditioning.condition(), conditioning.smallest,
                   found.knows_errors ? fmt::format("{:.2g}", conditioning.noise) : "unknown", channel.regularisation,
                   channel.series_radius, channel.series_radius < 1.0 ? "" : " diverges");
    }
    fmt::print("\n{:>6}{:>26}{:>16}", "bounce", "backward, C^i L", "discretisation");
    if (!forward.empty()) fmt::print("{:>26}{:>12}{:>11}{:>20}", "forward, K^i Le", "difference", "in errors", "regions, by noise");
    const bool knows_unseen = !forward.empty() && forward.front().by_way_of_unseen;
    if (knows_unseen) fmt::print("{:>18}", "by way of unseen");
    fmt::print("\n");
    for (std::size_t n = 0; n < found.terms.size(); ++n) {
        fmt::print("{:>6}{:>26}{:>16}", n + 1, with_error(found.means[n].all, found.knows_errors),
                   found.discretisation.empty() ? "unknown" : fmt::format("{:.2g}", found.discretisation[n]));
        if (n < forward.size()) {
            const TermAgreement& term = forward[n];
            fmt::print("{:>26}{:>11.2f}%{:>11.2f}{:>20}", with_error(term.forward, term.forward.standard_error > 0.0),
                       100.0 * term.difference.mean / term.forward.mean, term.deviations(),
                       fmt::format("{:.2f}%, {:.2f}%", 100.0 * term.relative_difference, 100.0 * term.by_noise));
            if (knows_unseen) fmt::print("{:>17.2f}%", 100.0 * term.by_way_of_unseen->mean / term.forward.mean);
        }
        fmt::print("\n");
    }
    fmt::print("\n");
    for (const Doubt& doubt : doubts) fmt::print("Doubt: {}.\n", doubt.words);
    if (doubts.empty()) fmt::print("No reason for doubt was found.\n");
    fmt::print("The pictures are in {}: unbounced.png, backward_001.exr and so on\n", output);
}

}  // namespace

int unbounce_command(const UnbounceRequest& request) {
    blocks_of(request.lights);  // throws before anything is read
    std::error_code error;
    const bool is_folder = fs::is_directory(request.input.path, error);
    if (!is_folder && !fs::exists(request.input.path, error))
        throw InputError(request.input.path + ": no such file or folder; expected a folder of pictures, or a scene");
    const ThreadLimit threads(request.threads);
    std::optional<Scene> scene;
    if (!is_folder) scene.emplace(scene_of(request));
    catch_interrupts();
    Watch watch;
    watch.stop = interrupted;
    ProgressLine line(request.quiet);
    const std::string output = !request.output.empty() ? request.output
                               : is_folder
                                   ? (fs::path(request.input.path) / "unbounced").string()
                                   : (fs::path("out") / (fs::path(request.input.path).stem().string() + "-lights")).string();
    if (is_folder && fs::equivalent(request.input.path, output, error))
        throw InputError(fmt::format("-o {}: holds the pictures, which would be lost; expected another folder", output));

    Input input;
    if (is_folder) read_input(request, input);
    OutputFolder folder(output, "unbounce");
    if (scene) render_input(request, *scene, watch, line, input);
    if (request.direct && !input.pictures.direct)
        throw OptionError("direct",
                          fmt::format(": {} has no pictures of direct light, direct_000.exr and so on", request.input.path));

    UnbounceSettings settings{request.bounces, request.regularisation, request.direct, {}, request.seed};
    if (input.blocks && input.blocks->first > 1 && input.blocks->second > 1)
        settings.merged = merged_by_four(input.blocks->first, input.blocks->second);
    if (settings.merged.size() > 0 && settings.merged.back() == 0) settings.merged.clear();
    std::optional<Estimate> picture;
    if (!request.picture.empty()) {
        picture = read_light(request.picture);
        if (picture->mean.width != input.regions.width || picture->mean.height != input.regions.height)
            throw InputError(fmt::format("{}: {}×{} pixels, expected {}×{} as in the pictures of lights", request.picture,
                                         picture->mean.width, picture->mean.height, input.regions.width, input.regions.height));
    }
    line.show([] { return std::string("going backwards"); });
    const Unbounced found = unbounce(input.pictures, input.regions, picture ? &*picture : nullptr, settings, watch);
    const std::vector<TermAgreement> forward =
        agreement(found, input.forward, input.renders ? input.renders->by_way_of_unseen : std::vector<MeanWithError>());
    const std::vector<Doubt> doubts = doubts_about(found, input.pictures.names, forward);
    line.clear();

    Json json = input.json;
    json.update(unbounce_json(found, input.pictures.names, forward, doubts));
    json["command"] = request.command_line;
    json["version"] = NEUMANN_VERSION;
    if (input.renders) write_light_renders(folder, *input.renders);
    write_unbounced(folder, found, input.forward);
    folder.write("unbounce.json", json_text(json, 2) + "\n");
    folder.commit();
    if (input.renders) print_warnings(texts(input.renders->warnings), request.quiet);
    if (request.json)
        fmt::print("{}\n", json_text(json, 2));
    else if (!request.quiet)
        print(found, forward, doubts, output);
    return 0;
}

}  // namespace neumann
