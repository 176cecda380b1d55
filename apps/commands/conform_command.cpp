#include "apps/commands/conform_command.h"

#include "apps/output/files/json_text.h"
#include "apps/output/files/output_folder.h"
#include "core/base/error.h"
#include "core/base/interrupt.h"
#include "core/base/limits.h"
#include "core/base/stopwatch.h"
#include "core/image/colour/spectrum_to_rgb.h"
#include "core/image/image_io.h"
#include "core/reader/read_scene.h"
#include "operators/render/methods/render.h"
#include "operators/statistics/conformity.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <optional>

namespace neumann {

namespace {

namespace fs = std::filesystem;

// The default samples per pixel of Mitsuba's script that makes the references; the files do not contain the number.
constexpr std::uint64_t reference_samples = 32'000;

struct ConformScene {
    fs::path file, reference, variance;
    std::string integrator;  // the last word of the file's name

    std::string name() const { return (file.parent_path().filename() / file.stem()).string(); }
};

struct ConformResult {
    std::string name;
    std::string why_not;  // the reason why it was not judged
    std::uint64_t samples = 0;
    double seconds = 0.0;
    Conformity by_reference, by_error;
    double brightness = 0.0;  // the picture's mean Y divided by the reference's

    bool judged() const { return why_not.empty(); }
    bool rejected() const { return judged() && !(by_reference.conforms() && by_error.conforms()); }
};

std::vector<ConformScene> find_scenes(const ConformRequest& request) {
    const fs::path root = fs::path(request.folder) / "tests" / "scenes";
    std::vector<ConformScene> scenes;
    std::error_code error;
    for (const fs::directory_entry& folder : fs::directory_iterator(root, error)) {
        if (!folder.is_directory()) continue;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder.path())) {
            const std::string stem = entry.path().stem().string();
            const std::size_t last = stem.rfind('_');
            if (entry.path().extension() != ".xml" || last == std::string::npos) continue;
            const fs::path refs = folder.path() / "refs";
            const std::string name = stem.substr(0, last) + "_ref_rgb";
            ConformScene scene{entry.path(), refs / (name + ".exr"), refs / (name + "_var.exr"), stem.substr(last + 1)};
            if (request.only.empty() || scene.name().find(request.only) != std::string::npos) scenes.push_back(std::move(scene));
        }
    }
    if (error) throw InputError(fmt::format("{}: cannot be read: {}", root.string(), error.message()));
    if (scenes.empty()) throw InputError(fmt::format("{}: no scenes NAME_INTEGRATOR.xml in its folders", root.string()));
    std::sort(scenes.begin(), scenes.end(), [](const ConformScene& a, const ConformScene& b) { return a.file < b.file; });
    return scenes;
}

Image in_colors(const glm::dmat3& matrix, Image image) {
    for (Rgb& pixel : image.pixels) pixel = matrix * pixel;
    return image;
}

// Renders the sum of all bounces that the file specifies, in XYZ.
std::optional<Estimate> picture_of(const Scene& scene, std::uint64_t samples, std::uint64_t seed, const glm::dmat3& xyz_from_rgb) {
    method::Walk walk;
    walk.sampler = SamplerKind::independent;
    // Each sample is a replicate, because Student's t needs many.
    const Goal goal{.samples = samples,
                    .replicates = static_cast<std::uint32_t>(samples),
                    .seed = seed,
                    .colors = xyz_from_rgb,
                    .only_pictures = scene.bounces.has_value()};
    const BounceSeries series = render(scene, walk, goal, {.stop = interrupted});
    if (interrupted()) return std::nullopt;
    if (scene.bounces) return series.sum(static_cast<std::size_t>(series.bounces()));
    if (!series.limit) throw InputError("the series does not end: there is no sum of all bounces");
    return series.limit();
}

void write_pictures(const fs::path& folder, const ConformResult& result, const Estimate& picture, const Image& reference,
                    const glm::dmat3& rgb_from_xyz) {
    Image difference = picture.mean;
    for (std::size_t i = 0; i < difference.pixels.size(); ++i) difference.pixels[i] -= reference.pixels[i];
    OutputFolder files(folder, "conform");
    const auto write = [&](const char* name, const Image& image) {
        files.write(name, encode_exr(Estimate{image, {}}, {{"neumann:scene", result.name}}));
    };
    write("picture.exr", in_colors(rgb_from_xyz, picture.mean));
    write("reference.exr", in_colors(rgb_from_xyz, reference));
    write("difference.exr", in_colors(rgb_from_xyz, difference));
    write("p-reference.exr", result.by_reference.p_values);
    write("p-error.exr", result.by_error.p_values);
    files.commit();
}

std::optional<ConformResult> judge(const ConformScene& scene, const ConformRequest& request) {
    ConformResult result;
    result.name = scene.name();
    const glm::dmat3 to_xyz = glm::inverse(rgb_from_xyz());
    try {
        for (const fs::path& file : {scene.reference, scene.variance})
            if (!fs::exists(file)) throw InputError("there is no reference " + file.filename().string());
        const SampledReference reference{in_colors(to_xyz, read_exr(scene.reference.string()).mean),
                                         in_colors(to_xyz, read_exr(scene.variance.string()).mean), reference_samples};
        const Scene loaded = [&] {
            const EndsAtInterrupts reading;
            return read_scene(scene.file.string(), {{"integrator", scene.integrator}}, {.optional_definitions = true});
        }();
        const auto pixels =
            static_cast<std::uint64_t>(loaded.film.crop_width) * static_cast<std::uint64_t>(loaded.film.crop_height);
        result.samples = std::max<std::uint64_t>(2, request.budget / pixels);
        const Stopwatch watch;
        const std::optional<Estimate> picture = picture_of(loaded, result.samples, request.seed, to_xyz);
        if (!picture) return std::nullopt;
        result.seconds = watch.seconds();
        result.by_reference = conformity_by_reference(picture->mean, result.samples, reference);
        result.by_error = conformity_by_error(*picture, reference);
        result.brightness = brightness(picture->mean, reference.mean);
        if (result.rejected())
            write_pictures(fs::path(request.output) / result.name, result, *picture, reference.mean, rgb_from_xyz());
    } catch (const InputError& error) {
        result.why_not = error.what();
    }
    return result;
}

const char* verdict(const Conformity& c) { return c.conforms() ? "accepted" : "REJECTED"; }

void print_header() {
    fmt::print("{:<43}{:>6}{:>8}  {:>9} {:<9} {:>9} {:<9} {:>10}\n", "scene", "spp", "seconds", "Mitsuba's", "test", "our own",
               "test", "Y of ref.");
}

void print_row(const ConformResult& r) {
    if (r.judged())
        fmt::print("{:<43}{:>6}{:>8.1f}  {:>8.3f}% {:<9} {:>8.3f}% {:<9} {:>10.5f}\n", r.name, r.samples, r.seconds,
                   100.0 * r.by_reference.accepted, verdict(r.by_reference), 100.0 * r.by_error.accepted, verdict(r.by_error),
                   r.brightness);
    else
        fmt::print("{:<43}  not rendered: {}\n", r.name, r.why_not);
    std::fflush(stdout);
}

void print_summary(const std::vector<ConformResult>& results, std::size_t scenes, const ConformRequest& request) {
    const auto count = [&](const auto& holds) { return std::count_if(results.begin(), results.end(), holds); };
    const auto rejected = count([](const ConformResult& r) { return r.rejected(); });
    fmt::print("\n{} accepted, {} rejected, {} not rendered",
               count([](const ConformResult& r) { return r.judged() && !r.rejected(); }), rejected,
               count([](const ConformResult& r) { return !r.judged(); }));
    if (results.size() < scenes) fmt::print(", {} not reached", scenes - results.size());
    fmt::print(
        "\nThe parts of the pixels' channels (XYZ) that pass; 99.75% have to. Mitsuba's test: against the reference's variance "
        "over our "
        "samples;\nour own: against our standard error and that of {} samples of the reference.\n",
        reference_samples);
    if (rejected > 0) fmt::print("Pictures of the rejected: {}\n", request.output);
}

nlohmann::ordered_json json_of(const ConformResult& r) {
    nlohmann::ordered_json j = {{"scene", r.name}};
    if (!r.judged()) {
        j["not_rendered"] = r.why_not;
        return j;
    }
    j["samples"] = r.samples;
    j["seconds"] = r.seconds;
    j["mitsuba"] = {{"accepted_part", r.by_reference.accepted}, {"conforms", r.by_reference.conforms()}};
    j["own"] = {{"accepted_part", r.by_error.accepted}, {"conforms", r.by_error.conforms()}};
    j["brightness_of_reference"] = r.brightness;
    return j;
}

}  // namespace

int conform_command(const ConformRequest& request) {
    const ThreadLimit threads(request.threads);
    catch_interrupts();
    const std::vector<ConformScene> scenes = find_scenes(request);
    std::vector<ConformResult> results;
    if (!request.json) print_header();
    for (const ConformScene& scene : scenes) {
        std::optional<ConformResult> result = judge(scene, request);
        if (!result) break;
        if (!request.json) print_row(*result);
        results.push_back(std::move(*result));
    }
    if (request.json) {
        nlohmann::ordered_json j = {{"scenes", nlohmann::ordered_json::array()}, {"of", scenes.size()}};
        for (const ConformResult& r : results) j["scenes"].push_back(json_of(r));
        fmt::print("{}\n", json_text(j, 2));
    } else {
        print_summary(results, scenes.size(), request);
    }
    return std::any_of(results.begin(), results.end(), [](const ConformResult& r) { return r.rejected(); }) ? 1 : 0;
}

}  // namespace neumann
