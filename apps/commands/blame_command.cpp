#include "apps/commands/blame_command.h"

#include "apps/commands/interrupt.h"
#include "apps/commands/limits.h"
#include "apps/commands/parse_definitions.h"
#include "apps/commands/print_warnings.h"
#include "apps/files/json_number.h"
#include "core/base/error.h"
#include "core/image/image_io.h"
#include "core/reader/read_scene.h"
#include "operators/blame/blame.h"

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

Image read_picture(const std::string& path) {
    const Texels texels = read_texels(path);
    if (texels.values.empty() || texels.is_encoded)
        throw InputError(path + ": holds whole numbers, expected radiance in floats, such as OpenEXR");
    Image image(texels.width, texels.height);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c)
                image.at(x, y)[c] =
                    double{texels.values[texels.index(x, y) + static_cast<std::size_t>(texels.channels == 3 ? c : 0)]};
    return image;
}

// By number. Of a folder, all OpenEXR files.
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
            pictures.push_back({number, read_picture(file)});
            continue;
        }
        const auto second = again.find(number);
        if (second == again.end()) throw InputError(fmt::format("{}: --again has no picture with the number {}", file, number));
        pictures.push_back(mean_of_two(number, read_picture(file), read_picture(second->second)));
    }
    return pictures;
}

Counting counting_of(const std::string& name) {
    for (const Counting counting : {Counting::bounces, Counting::mitsuba, Counting::pbrt, Counting::cycles})
        if (name == name_of(counting)) return counting;
    throw InputError("--counts " + name + ": expected mitsuba, pbrt, cycles or bounces");
}

void print(const Blame& found) {
    fmt::print("{:<16}{:>12}{:>26}  {}\n", "", "theirs/ours", "95% interval", "by chance");
    for (const TermVerdict& t : found.terms)
        fmt::print(
            "{:<16}{:>12.4f}{:>26}  {}{}\n", to_string(t.bounces), t.test.ratio, fmt::format("± {:.2g}", 1.96 * t.test.ratio_error),
            t.test.p > 0.001 ? fmt::format("{:.2g}", t.test.p) : fmt::format("{:.0e}", t.test.p), t.differs ? "  differs" : "");
    fmt::print("\n");
    for (const std::string& sentence : found.sentences) fmt::print("{}\n", sentence);
    if (found.suspects.empty()) return;
    constexpr std::size_t shown = 5;
    fmt::print("\nLikeliest, with −2 log of how much less likely than the first:\n");
    for (std::size_t i = 0; i < std::min(shown, found.suspects.size()); ++i)
        fmt::print("{:>10.0f}  {}\n", found.suspects[i].misfit - found.suspects[0].misfit, found.suspects[i].words);
}

nlohmann::ordered_json json_of(const Blame& found) {
    nlohmann::ordered_json json;
    json["right"] = found.is_right();
    json["counting"] = name_of(found.counting);
    if (found.told) json["counting_by_the_data"] = name_of(*found.told);
    json["noise_known"] = found.knows_their_noise;
    for (const TermVerdict& t : found.terms)
        json["terms"].push_back({{"first", t.bounces.first},
                                 {"last", t.bounces.last},
                                 {"ratio", json_number(t.test.ratio)},
                                 {"ratio_stderr", json_number(t.test.ratio_error)},
                                 {"p", t.test.p},
                                 {"differs", t.differs}});
    for (const Suspect& s : found.suspects)
        json["suspects"].push_back(
            {{"name", s.name}, {"words", s.words}, {"misfit", json_number(s.misfit)}, {"p_of_what_is_left", s.left.p}});
    for (const Place& p : found.worst) json["worst_pixels"].push_back({{"x", p.x}, {"y", p.y}, {"z", json_number(p.z)}});
    json["sentences"] = found.sentences;
    return json;
}

}  // namespace

int blame_command(const BlameRequest& request) {
    if (request.pictures.size() < 2) throw InputError("expected pictures and a scene: neumann blame depth_*.exr scene.xml");
    BlameSettings settings;
    if (request.counts) settings.counting = counting_of(*request.counts);
    if (request.seconds) settings.seconds = *request.seconds;
    settings.samples = request.samples;
    settings.seed = request.seed;
    const std::vector<DepthPicture> pictures = read_pictures(request);
    const Scene scene = read_scene(request.pictures.back(), parse_definitions(request.definitions), {.lenient = request.lenient});
    print_warnings(scene.replaced, false);
    const ThreadLimit threads(request.threads);
    catch_interrupts();
    Watch watch;
    watch.stop = interrupted;
    const Blame found = blame(scene, pictures, settings, watch);
    if (request.json)
        fmt::print("{}\n", json_of(found).dump(2));
    else
        print(found);
    return 0;
}

}  // namespace neumann
