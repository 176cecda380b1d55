#include "apps/commands/replay_command.h"

#include "apps/files/health_json.h"
#include "apps/files/method_json.h"
#include "core/base/error.h"
#include "core/reader/read_scene.h"
#include "operators/methods/recorded_render.h"
#include "operators/pictures/path_group.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;

// A render as its run.json tells it.
struct RecordedRun {
    std::string scene, hash, version;
    std::map<std::string, std::string> definitions;
    bool lenient = false;
    RecordedRender render;
    std::uint64_t first = 0, samples = 0;  // of a part, the first is above 0
    std::vector<SeedRange> merged;         // where the samples are of several seeds
    Json named;                            // the samples that the health report names
};

RecordedRun read_run(const std::string& folder) {
    if (!std::filesystem::is_directory(folder)) throw InputError(folder + ": is not a folder; expected that of a render");
    const std::string path = (std::filesystem::path(folder) / "run.json").string();
    std::ifstream file(path);
    if (!file) throw InputError(path + ": cannot be read; expected the folder of a finished render");
    try {
        const Json json = Json::parse(file);
        const Json &options = json.at("options"), &samples = json.at("samples");
        RecordedRun run;
        RecordedRender& render = run.render;
        render.method = method_from_json(options);
        if (const std::string why = why_no_replay(render.method); !why.empty())
            throw InputError(fmt::format("{}: --method {} has no paths to replay: {}", folder, name_of(render.method), why));
        run.scene = json.at("scene").at("file");
        json.at("scene").at("definitions").get_to(run.definitions);
        run.lenient = json.at("scene").contains("replaced");
        run.hash = json.at("scene").at("hash");
        run.version = json.at("program").at("version");
        render.seed = options.at("seed");
        render.bounces = options.at("bounces");
        render.rest_probability = json.at("rest").value("probability_of_being_sampled", 0.0);
        render.replicate_size = samples.at("replicate_size");
        run.samples = samples.at("per_pixel");
        run.first = samples.value("first_replicate", std::uint64_t{0}) * render.replicate_size;
        if (samples.contains("merged"))
            for (const Json& range : samples.at("merged"))
                run.merged.push_back({range.at("seed"), range.at("first_replicate"), range.at("replicates")});
        run.named = json.at("health").at("samples");
        return run;
    } catch (const Json::exception& e) {
        throw InputError(fmt::format("{}: is not a run.json of this program's renders: {}", path, e.what()));
    }
}

// The pixel's number, that of the sample there, and why it was named.
struct Chosen {
    SampleName name;
    std::string why;
};

std::uint32_t pixel_number(const Film& film, int x, int y) {
    const std::optional<std::uint32_t> number = number_of(film, {x, y});
    if (!number)
        throw InputError(fmt::format("--pixel {},{}: the picture has x from {} to {} and y from {} to {}", x, y, film.crop_x,
                                     film.crop_x + film.crop_width - 1, film.crop_y, film.crop_y + film.crop_height - 1));
    return *number;
}

void expect_sample(std::uint64_t sample, std::uint64_t first, std::uint64_t count) {
    if (sample < first || sample - first >= count)
        throw InputError(
            fmt::format("--sample {}: expected {} to {}, as many as the render has a pixel", sample, first, first + count - 1));
}

Chosen choose(const ReplayRequest& request, const RecordedRun& run, const Film& film) {
    if (!request.number) {
        const bool alike = !adaptive_of(run.render.method) && !std::holds_alternative<method::Mixed>(run.render.method);
        if (alike) expect_sample(*request.sample, run.first, run.samples);
        return {{pixel_number(film, request.pixel[0], request.pixel[1]), *request.sample}, ""};
    }
    for (const Json& sample : run.named) {
        if (sample.at("number") != *request.number) continue;
        const Json& pixel = sample.contains("pixel_of_path") ? sample.at("pixel_of_path") : sample.at("pixel");
        return {{pixel_number(film, pixel.at(0), pixel.at(1)), sample.at("sample").get<std::uint64_t>()},
                fmt::format("bounce {}: {}", sample.at("bounce").get<int>(), sample.at("why").get<std::string>())};
    }
    throw InputError(run.named.empty()
                         ? fmt::format("{}: its health report names no sample; take --pixel X,Y --sample S", request.folder)
                         : fmt::format("{}: its health report names samples 1 to {}, not {}", request.folder, run.named.size(),
                                       *request.number));
}

// A render with its settings made again, and the name there of a sample; of a merged render, the one of its seeds that has it.
struct Beginning {
    std::unique_ptr<const RecordedSamples> samples;
    SampleName name;
};
Beginning where_it_began(const Scene& scene, const RecordedRun& run, SampleName name) {
    const std::uint32_t pixel = name.pixel;
    if (!run.merged.empty() && std::holds_alternative<method::Mixed>(run.render.method))
        throw InputError(
            "replay: a mixture's samples have their numbers in the render of one seed; expected one of those that were merged");
    const std::uint64_t asked = name.sample;
    const auto size_in = [&](const RecordedSamples& samples) { return std::uint64_t{samples.sampler().layout().size(pixel)}; };
    for (const SeedRange& range : run.merged) {
        RecordedRender render = run.render;
        render.seed = range.seed;
        auto samples = std::make_unique<const RecordedSamples>(scene, render);
        const std::uint64_t size = size_in(*samples);
        if (name.sample < range.count * size) {
            name.sample += range.first * size;
            return {std::move(samples), name};
        }
        name.sample -= range.count * size;
    }
    if (!run.merged.empty()) expect_sample(asked, 0, asked - name.sample);
    auto samples = std::make_unique<const RecordedSamples>(scene, run.render);
    if (const MixedSampler* mixed = samples->sampler().mixed()) {
        const auto& [sampler, name_there, part, method] = mixed->part_of(name);
        const std::uint64_t of_part = sampler.layout().size(pixel), n = run.samples / run.render.replicate_size * of_part,
                            begin = run.first / run.render.replicate_size * of_part;
        if (name_there.sample < begin || name_there.sample - begin >= n)
            throw InputError(fmt::format("--sample {}: {} has {} samples in this pixel; expected {} j + {} with j from {} on",
                                         asked, method, n, mixed->parts(), part, begin));
        return {std::move(samples), name};
    }
    const std::uint64_t size = size_in(*samples), replicates = run.samples / run.render.replicate_size,
                        first = run.first / run.render.replicate_size * size;
    expect_sample(name.sample, first, replicates * size);
    return {std::move(samples), name};
}

std::string text(const Vec3& v) { return fmt::format("{:.6g} {:.6g} {:.6g}", v.x, v.y, v.z); }

std::string heading(const PathStep& step) {
    const char* half = step.from_light ? "light" : "camera";
    switch (step.kind) {
        case PathStep::Kind::first:
            return fmt::format("from the {}", half);
        case PathStep::Kind::goes_on:
            return fmt::format("reflection {}{}", step.bounce, step.from_light ? " of the light's path" : "");
        case PathStep::Kind::record:
            return "from the record of the cache that brings most, its brightest ray";
        case PathStep::Kind::asks:
            return fmt::format("{} for bounce {}", step.from_light ? "looks at the camera" : "looks for light", step.bounce);
    }
    return "";
}

void print(const ReplayedStep& s, const Scene& scene, bool first_unsound) {
    const PathStep& step = s.step;
    fmt::print("{}{}\n", heading(step), first_unsound ? "    <── here a value is no finite number any more" : "");
    fmt::print("    from      {}\n    along     {}\n", text(step.from.position), text(step.w));
    if (step.kind == PathStep::Kind::goes_on && !step.from_light)
        fmt::print("    pdf       {}\n", step.pdf == delta_pdf ? "the only direction" : fmt::format("{:.6g} per sr", step.pdf));
    if (step.kind != PathStep::Kind::asks)
        fmt::print("    {} {}\n", step.from_light ? "power     " : "throughput", text(step.beta));
    if (step.kind == PathStep::Kind::asks)
        fmt::print("    {}\n", step.found ? "nothing is in between" : "hidden, or nothing is there");
    else if (step.to.is_infinite())
        fmt::print("    meets     nothing\n");
    else
        fmt::print("    meets     {}, triangle {}\n    at        {}\n    normal    {}\n", name_of_shape(scene, step.to.shape),
                   step.to.primitive, text(step.to.position), text(step.to.normal));
    for (const auto& found : s.found)
        fmt::print("    brings    {} in bounce {}{}\n", text(found.value), found.quantity,
                   found.pixel ? fmt::format(", at {:.6g}, {:.6g} on the film", found.pixel->x, found.pixel->y) : "");
}

Json rgb(const Vec3& x) {
    Json json = Json::array();
    for (int c = 0; c < 3; ++c) json.push_back(std::isfinite(x[c]) ? Json(x[c]) : Json(fmt::format("{}", x[c])));
    return json;
}

Json as_json(const ReplayedStep& s, const Scene& scene) {
    const PathStep& step = s.step;
    Json json = {{"ray", heading(step)}, {"bounce", step.bounce}, {"from", rgb(step.from.position)}, {"along", rgb(step.w)}};
    if (step.kind == PathStep::Kind::goes_on && !step.from_light)
        json["pdf"] = step.pdf == delta_pdf ? Json("delta") : Json(step.pdf);
    if (step.kind != PathStep::Kind::asks) json[step.from_light ? "power" : "throughput"] = rgb(step.beta);
    json["found"] = step.found;
    if (step.found && step.kind != PathStep::Kind::asks)
        json["meets"] = {{"shape", name_of_shape(scene, step.to.shape)},
                         {"triangle", step.to.primitive},
                         {"at", rgb(step.to.position)},
                         {"normal", rgb(step.to.normal)}};
    for (const auto& found : s.found) {
        Json brought = {{"bounce", found.quantity}, {"value", rgb(found.value)}};
        if (found.pixel) brought["film"] = {found.pixel->x, found.pixel->y};
        json["brings"].push_back(brought);
    }
    json["finite"] = is_finite(s);
    return json;
}

}  // namespace

int replay_command(const ReplayRequest& request) {
    if (!request.number && request.pixel.empty())
        throw InputError("which sample? Take N, the number of one that the health report names, or --pixel X,Y --sample S");
    const RecordedRun run = read_run(request.folder);
    if (!std::filesystem::exists(run.scene))
        throw InputError(fmt::format("{}: the scene of {} is not there; the name is relative to where the render was started",
                                     run.scene, request.folder));
    const Scene scene = read_scene(run.scene, run.definitions, {.lenient = run.lenient});
    if (scene.hash != run.hash)
        fmt::print(stderr, "warning: {} has changed since {} was rendered: this is not the sample that was rendered\n", run.scene,
                   request.folder);
    if (run.version != NEUMANN_VERSION)
        fmt::print(stderr, "warning: {} was rendered by version {}, and this is {}\n", request.folder, run.version,
                   NEUMANN_VERSION);
    const Chosen chosen = choose(request, run, scene.film);
    const auto [samples, name] = where_it_began(scene, run, chosen.name);
    const Replay found = samples->replay(name);
    const Pixel pixel = pixel_of(scene.film, chosen.name.pixel);
    const MixedSampler* mixed = samples->sampler().mixed();
    const std::string method = mixed ? fmt::format("mixed ({})", mixed->part_of(name).method) : name_of(run.render.method);
    const auto unsound = std::find_if(found.steps.begin(), found.steps.end(), [](const ReplayedStep& s) { return !is_finite(s); });

    if (request.json) {
        Json json = {{"pixel", {pixel.x, pixel.y}}, {"sample", chosen.name.sample}, {"method", method}};
        if (!chosen.why.empty()) json["why"] = chosen.why;
        json["terms"] = Json::array();
        for (const Rgb& term : found.terms) json["terms"].push_back(rgb(term));
        json["steps"] = Json::array();
        for (const ReplayedStep& s : found.steps) json["steps"].push_back(as_json(s, scene));
        if (unsound != found.steps.end()) json["first_step_that_is_not_finite"] = unsound - found.steps.begin();
        fmt::print("{}\n", json.dump(2));
        return 0;
    }
    fmt::print("Sample {} of pixel {},{} by {}{}\n\n", chosen.name.sample, pixel.x, pixel.y, method,
               chosen.why.empty() ? "" : "; " + chosen.why);
    for (auto s = found.steps.begin(); s != found.steps.end(); ++s) print(*s, scene, s == unsound);
    fmt::print("\nWhat it brings to its own pixel\n");
    for (std::size_t q = 0; q < found.terms.size(); ++q)
        fmt::print("{:>8}  {}\n", q + 1 == found.terms.size() ? "rest" : fmt::format("bounce {}", q),
                   fmt::format("{:.9g} {:.9g} {:.9g}", found.terms[q].r, found.terms[q].g, found.terms[q].b));
    return 0;
}

}  // namespace neumann
