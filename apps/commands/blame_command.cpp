#include "apps/commands/blame_command.h"

#include "apps/commands/print_warnings.h"
#include "apps/output/files/blame_files.h"
#include "apps/output/files/json_text.h"
#include "apps/output/files/other_picture.h"
#include "apps/output/pages/blame_page.h"
#include "core/base/error.h"
#include "core/base/interrupt.h"
#include "core/base/limits.h"
#include "core/image/image_io.h"
#include "core/reader/read_scene.h"
#include "operators/experiments/blame/blame.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>

namespace neumann {

namespace {

namespace fs = std::filesystem;

// The last number in a file's name: 3 of "room_depth03.exr".
int number_in(const std::string& path) {
    const std::string name = fs::path(path).stem().string();
    std::size_t end = name.size();
    while (end > 0 && !std::isdigit(static_cast<unsigned char>(name[end - 1]))) --end;
    std::size_t begin = end;
    while (begin > 0 && std::isdigit(static_cast<unsigned char>(name[begin - 1]))) --begin;
    int number = 0;
    const auto [at, error] = std::from_chars(name.data() + begin, name.data() + end, number);
    if (begin == end || error != std::errc())
        throw InputError(path + ": expected the picture's depth limit as the last number in its name, as in depth_3.exr");
    return number;
}

// The files by their numbers. A folder stands for all OpenEXR files in it.
std::map<int, std::string> files_by_number(const std::vector<std::string>& given) {
    std::vector<std::string> files;
    for (const std::string& path : given) {
        std::error_code error;
        if (!fs::is_directory(path, error)) {
            files.push_back(path);
            continue;
        }
        const std::size_t before = files.size();
        for (const auto& entry : fs::directory_iterator(path))
            if (entry.path().extension() == ".exr") files.push_back(entry.path().string());
        if (files.size() == before) throw InputError(path + ": no .exr in this folder");
    }
    std::map<int, std::string> numbered;
    for (const std::string& file : files)
        if (const auto [known, is_new] = numbered.try_emplace(number_in(file), file); !is_new)
            throw InputError(fmt::format("{} and {} have the same number", known->second, file));
    return numbered;
}

std::vector<DepthPicture> read_pictures(const BlameRequest& request) {
    const std::vector<std::string> given(request.pictures.begin(), request.pictures.end() - 1);
    const std::map<int, std::string> files = files_by_number(given), again = files_by_number(request.again);
    std::vector<DepthPicture> pictures;
    for (const auto& [number, file] : files) {
        if (again.empty()) {
            pictures.push_back({number, read_other_picture(file, request.channels)});
            continue;
        }
        const auto second = again.find(number);
        if (second == again.end()) throw InputError(fmt::format("{}: --again has no picture with the number {}", file, number));
        pictures.push_back(
            mean_of_two(number, read_other_picture(file, request.channels), read_other_picture(second->second, request.channels)));
    }
    return pictures;
}

Counting counting_of(const std::string& name) {
    for (const Counting counting : {Counting::bounces, Counting::mitsuba, Counting::pbrt, Counting::cycles})
        if (name == name_of(counting)) return counting;
    throw OptionError("counts", " " + name + ": expected mitsuba, pbrt, cycles or bounces");
}

void print_places(const std::vector<WorstPlace>& places, const Scene& scene) {
    if (places.empty()) return;
    fmt::print("\nWhere it differs most, in standard errors of a block of pixels, with a path of ours there:\n");
    for (const WorstPlace& p : places)
        fmt::print("{:>10.0f}  {},{} to {},{}: theirs {:.3g}, ours {:.3g}; {}\n", p.z, p.x, p.y, p.x + p.width - 1,
                   p.y + p.height - 1, mean_component(p.theirs), mean_component(p.ours), path_text(p.path, scene));
}

void print(const Blame& found, const Scene& scene, const std::string& output) {
    fmt::print("{:<16}{:>12}{:>26}  {}\n", "", "theirs/ours", "95% interval", "by chance");
    for (const TermVerdict& t : found.terms)
        fmt::print("{:<16}{:>12.4f}{:>26}  {}{}\n", to_string(t.bounces), t.test.ratio,
                   fmt::format("± {:.2g}", 1.96 * t.test.ratio_error),
                   t.test.p > 0.001 ? fmt::format("{:.2g}", t.test.p) : fmt::format("{:.0e}", t.test.p),
                   t.differs ? "  differs"
                   : t.doubt ? "  unclear"
                             : "");
    fmt::print("\n");
    for (const std::string& sentence : found.sentences) fmt::print("{}\n", sentence);
    if (found.first_wrong) {
        constexpr std::size_t shown = 5;
        fmt::print("\nLikeliest, with −2 log of how much less likely than the first:\n");
        for (std::size_t i = 0; i < std::min(shown, found.suspects.size()); ++i)
            fmt::print("{:>10.0f}  {}\n", found.suspects[i].misfit - found.suspects[0].misfit, found.suspects[i].words);
        print_places(found.terms[*found.first_wrong].worst, scene);
    }
    if (!output.empty()) fmt::print("\nThe pictures are on the page {}\n", (fs::path(output) / "index.html").string());
}

// The verdict with everything needed to repeat it.
nlohmann::ordered_json json_of(const Blame& found, const Scene& scene, const BlameRequest& request) {
    nlohmann::ordered_json json = blame_json(found, scene);
    json["scene"] = request.pictures.back();
    json["pictures"] = std::vector<std::string>(request.pictures.begin(), request.pictures.end() - 1);
    json["again"] = request.again;
    json["seed"] = request.seed;
    json["command"] = request.command_line;
    json["version"] = NEUMANN_VERSION;
    return json;
}

void write_page(OutputFolder& folder, const Blame& found, const nlohmann::ordered_json& json) {
    const PackedSeries pictures = packed_pictures(found);
    if (pictures.factor() > 1) fmt::print(stderr, "note: {}\n", pictures.reduction());
    write_blame_pictures(folder, found);
    folder.write("blame.json", json_text(json, 2) + "\n");
    folder.write("index.html", blame_page(pictures, json));
    folder.commit();
}

}  // namespace

BlameSettings blame_settings(const BlameRequest& request) {
    BlameSettings settings;
    if (request.counts) settings.counting = counting_of(*request.counts);
    if (request.seconds) settings.seconds = *request.seconds;
    settings.samples = request.samples;
    settings.seed = request.seed;
    return settings;
}

int blame_command(const BlameRequest& request) {
    if (request.pictures.size() < 2) throw InputError("expected pictures and a scene: neumann blame depth_*.exr scene.xml");
    const BlameSettings settings = blame_settings(request);
    const std::vector<DepthPicture> pictures = read_pictures(request);
    SceneFile file = request.scene;
    file.path = request.pictures.back();
    const Scene scene = read_scene(file);
    print_warnings(scene.replaced, false);
    const ThreadLimit threads(request.threads);
    catch_interrupts();
    std::optional<OutputFolder> folder;
    if (!request.output.empty()) {
        expect_pictures();  // fails before anything is sampled
        folder.emplace(request.output, "blame");
    }
    Watch watch;
    watch.stop = interrupted;
    const Blame found = blame(scene, pictures, settings, watch);
    const nlohmann::ordered_json json = json_of(found, scene, request);
    if (folder) write_page(*folder, found, json);
    if (request.json)
        fmt::print("{}\n", json_text(json, 2));
    else
        print(found, scene, request.output);
    return 0;
}

}  // namespace neumann
