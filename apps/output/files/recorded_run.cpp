#include "apps/output/files/recorded_run.h"

#include "apps/output/files/health_json.h"
#include "apps/output/files/json_text.h"
#include "apps/output/files/method_json.h"
#include "core/base/error.h"
#include "core/base/input_file.h"
#include "operators/paths/walk/path_group.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

namespace neumann {

using Json = nlohmann::ordered_json;

namespace {

void expect_paths(const Method& method, const std::string& folder) {
    if (const std::string why = why_no_replay(method); !why.empty())
        throw InputError(fmt::format("{}: {} has no paths to replay: {}", folder, name_of(method), why));
}

RecordedRun recorded_run(const Json& json, const std::string& folder) {
    const Json &options = json.at("options"), &samples = json.at("samples"), &scene = json.at("scene");
    RecordedRun run;
    run.folder = folder;
    RecordedRender& render = run.render;
    render.method = method_from_json(options);
    expect_paths(render.method, folder);
    run.scene = {file_named_in_json(scene.at("file")), scene.at("definitions"), scene.contains("replaced")};
    if (scene.contains("hemisphere")) run.scene.hemisphere = scene.at("hemisphere").get<std::array<int, 2>>();
    run.hash = scene.at("hash");
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
    for (const Json& sample : json.at("health").at("samples")) {
        const Json& pixel = sample.contains("pixel_of_path") ? sample.at("pixel_of_path") : sample.at("pixel");
        run.named.push_back({{pixel.at(0), pixel.at(1)},
                             sample.at("sample"),
                             fmt::format("bounce {}: {}", sample.at("bounce").get<int>(), sample.at("why").get<std::string>())});
    }
    return run;
}

}  // namespace

RecordedRun recorded_run(const BounceSeries& series, const SceneFile& file, const Scene& scene, const std::string& folder) {
    expect_paths(series.method, folder);
    const auto& paths = std::get<PathRecord>(series.record);
    const RecordedRender render{series.method, series.seed, static_cast<int>(series.bounces()),
                                paths.rest_probability.value_or(0.0), paths.replicate_size};
    RecordedRun run{folder,         scene.hash,   NEUMANN_VERSION,
                    file,           render,       paths.first_replicate * paths.replicate_size,
                    series.samples, paths.merged, {}};
    if (paths.health)
        for (const auto& [name, why] : named_samples(*paths.health))
            run.named.push_back({pixel_of(scene.film, name.pixel), name.sample, why});
    return run;
}

RecordedRun read_recorded_run(const std::string& folder) {
    if (!std::filesystem::is_directory(folder)) throw InputError(folder + ": is not a folder; expected that of a render");
    const std::string path = (std::filesystem::path(folder) / "run.json").string();
    std::ifstream file = open_if_there(path);
    if (!file) throw InputError(path + ": cannot be read; expected the folder of a finished render");
    try {
        return recorded_run(Json::parse(file), folder);
    } catch (const Json::exception& e) {
        throw InputError(fmt::format("{}: is not a run.json of this program's renders: {}", path, e.what()));
    }
}

Scene read_scene_of(const RecordedRun& run) {
    if (!std::filesystem::exists(run.scene.path))
        throw InputError(fmt::format("{}: the scene of {} is not there; the name is relative to where the render was started",
                                     run.scene.path, run.folder));
    Scene scene = read_scene(run.scene);
    if (scene.hash != run.hash)
        fmt::print(stderr, "warning: {} has changed since {} was rendered: this is not the sample that was rendered\n",
                   run.scene.path, run.folder);
    if (run.version != NEUMANN_VERSION)
        fmt::print(stderr, "warning: {} was rendered by version {}, and this is {}\n", run.folder, run.version, NEUMANN_VERSION);
    return scene;
}

std::uint32_t pixel_number(const Film& film, int x, int y, const char* option) {
    const std::optional<std::uint32_t> number = number_of(film, {x, y});
    if (!number)
        throw InputError(fmt::format("{} {},{}: the picture has x from {} to {} and y from {} to {}", option, x, y, film.crop_x,
                                     film.crop_x + film.crop_width - 1, film.crop_y, film.crop_y + film.crop_height - 1));
    return *number;
}

std::vector<ReportedSample> reported_samples(const RecordedRun& run, const Film& film) {
    std::vector<ReportedSample> all;
    for (const auto& [pixel, sample, why] : run.named)
        all.push_back({{pixel_number(film, pixel.x, pixel.y, "a named sample's pixel"), sample}, why});
    return all;
}

namespace {

void expect_sample(std::uint64_t sample, std::uint64_t first, std::uint64_t count) {
    if (sample < first || sample - first >= count)
        throw OptionError(
            "sample", fmt::format("{}: expected {} to {}, as many as the render has a pixel", sample, first, first + count - 1));
}

}  // namespace

const RecordedSamples& RecordedSamplers::of_seed(std::size_t i) {
    auto& samples = made_[i];
    if (!samples) {
        RecordedRender render = run_.render;
        if (!run_.merged.empty()) render.seed = run_.merged[i].seed;
        samples = std::make_unique<const RecordedSamples>(scene_, render);
    }
    return *samples;
}

RecordedSamplers::FoundSample RecordedSamplers::find(SampleName name) {
    const std::uint32_t pixel = name.pixel;
    const std::uint64_t requested = name.sample;
    if (!run_.merged.empty() && std::holds_alternative<method::Mixed>(run_.render.method))
        throw InputError(
            "a mixture's samples have their numbers in the render of one seed; expected one of those that were merged");
    // If all pixels have equally many samples, the number is checked before a pilot takes its time.
    if (!adaptive_of(run_.render.method) && !std::holds_alternative<method::Mixed>(run_.render.method))
        expect_sample(requested, run_.first, run_.samples);
    for (std::size_t i = 0; i < run_.merged.size(); ++i) {
        const SeedRange& range = run_.merged[i];
        const RecordedSamples& samples = of_seed(i);
        const std::uint64_t size = samples.sampler().layout().size(pixel);
        if (name.sample < range.count * size) return {samples, {pixel, name.sample + range.first * size}};
        name.sample -= range.count * size;
    }
    if (!run_.merged.empty()) expect_sample(requested, 0, requested - name.sample);
    const RecordedSamples& samples = of_seed(0);
    const std::uint64_t replicates = run_.samples / run_.render.replicate_size, first = run_.first / run_.render.replicate_size;
    if (const PathSampler& all = samples.sampler().path_sampler(); all.parts() > 0) {
        const auto& [sampler, name_there, part, method] = all.part_of(name);
        const std::uint64_t of_part = sampler.layout().size(pixel), n = replicates * of_part, begin = first * of_part;
        if (name_there.sample < begin || name_there.sample - begin >= n)
            throw OptionError("sample", fmt::format("{}: {} has {} samples in this pixel; expected {} j + {} with j from {} on",
                                                    requested, method, n, all.parts(), part, begin));
        return {samples, name};
    }
    const std::uint64_t size = samples.sampler().layout().size(pixel);
    expect_sample(name.sample, first * size, replicates * size);
    return {samples, name};
}

std::vector<ReplicatesOf> RecordedSamplers::replicates() {
    const std::uint32_t size = run_.render.replicate_size;
    if (run_.merged.empty()) return {{of_seed(0).sampler(), run_.first / size, run_.samples / size}};
    std::vector<ReplicatesOf> all;
    for (std::size_t i = 0; i < run_.merged.size(); ++i)
        all.push_back({of_seed(i).sampler(), run_.merged[i].first, run_.merged[i].count});
    return all;
}

}  // namespace neumann
