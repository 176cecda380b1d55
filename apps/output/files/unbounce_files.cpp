#include "apps/output/files/unbounce_files.h"

#include "apps/output/files/json_number.h"
#include "apps/output/files/other_picture.h"
#include "apps/output/files/rendered_picture.h"
#include "apps/output/sheets/strips.h"
#include "apps/output/sheets/superscript.h"
#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/image/image_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace neumann {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t most_shown = 7;

std::string numbered(const char* name, std::size_t i) { return fmt::format("{}_{:03}.exr", name, i); }

std::vector<std::string> files_in(const std::string& folder) {
    std::vector<std::string> files;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
        if (entry->path().extension() == ".exr") files.push_back(entry->path().string());
    if (error) throw InputError(fmt::format("{}: cannot be read: {}", folder, error.message()));
    // This order puts light_1000.exr after light_999.exr.
    std::ranges::sort(files, [](const std::string& a, const std::string& b) { return strverscmp(a.c_str(), b.c_str()) < 0; });
    return files;
}

std::vector<std::string> beginning_with(const std::vector<std::string>& files, const std::string& prefix) {
    std::vector<std::string> found;
    std::ranges::copy_if(files, std::back_inserter(found),
                         [&](const std::string& file) { return fs::path(file).filename().string().starts_with(prefix); });
    return found;
}

std::optional<std::pair<int, int>> blocks_in(const std::string& folder) {
    std::ifstream file = open_if_there(fs::path(folder) / "unbounce.json");
    const Json json = Json::parse(file, nullptr, false);
    if (!json.is_object() || !json.contains("blocks") || !json["blocks"].is_array() || json["blocks"].size() != 2)
        return std::nullopt;
    if (!json["blocks"][0].is_number_integer() || !json["blocks"][1].is_number_integer()) return std::nullopt;
    return std::pair(json["blocks"][0].get<int>(), json["blocks"][1].get<int>());
}

Json mean_and_stderr(const MeanWithError& mean) {
    return {{"mean", json_number(mean.mean)}, {"stderr", json_number(mean.standard_error)}};
}

Json channel_json(const UnbouncedChannel& channel, const char* name) {
    const Conditioning& conditioning = channel.conditioning;
    return {{"channel", name},
            {"lights", channel.lights.size()},
            {"condition", json_number(conditioning.condition())},
            {"smallest_singular_value", json_number(conditioning.smallest)},
            {"noise", json_number(conditioning.noise)},
            {"singular", conditioning.is_singular()},
            {"regularisation", json_number(channel.regularisation)},
            {"inverse_series_radius", json_number(channel.series_radius)}};
}

Attributes attributes_of(const std::string& quantity, std::size_t bounce) {
    return {{"neumann:quantity", quantity}, {"neumann:bounce", static_cast<std::int64_t>(bounce)}};
}

std::string term_exr(const Unbounced& found, std::size_t n) {
    Attributes attributes = attributes_of("C^i L", n + 1);
    attributes["neumann:degrees_of_freedom"] = found.terms[n].degrees_of_freedom;
    attributes["neumann:pixels"] = std::string("correlated: their errors go together");
    if (found.knows_errors) attributes.merge(mean_attributes(found.means[n]));
    return encode_exr(found.terms[n], attributes);
}

}  // namespace

LightFolder read_light_folder(const std::string& folder) {
    const std::vector<std::string> files = files_in(folder);
    LightFolder result{beginning_with(files, "light_"), beginning_with(files, "direct_"), beginning_with(files, "forward_"), {}};
    if (result.lights.empty() && fs::exists(fs::path(folder) / "run.json"))
        throw InputError(
            folder + ": the bounces of a render; expected pictures under separate lights, or the scene, which is then rendered so");
    if (result.lights.empty())
        result.lights = files;
    else
        result.blocks = blocks_in(folder);
    if (result.lights.empty()) throw InputError(folder + ": no .exr in this folder; expected a picture for each of several lights");
    if (!result.direct.empty() && result.direct.size() != result.lights.size())
        throw InputError(fmt::format("{}: {} pictures of direct light, expected one for each of {} lights", folder,
                                     result.direct.size(), result.lights.size()));
    if (result.blocks &&
        static_cast<std::size_t>(result.blocks->first) * static_cast<std::size_t>(result.blocks->second) != result.lights.size())
        throw InputError(fmt::format("{}: {} pictures, expected {}×{} as unbounce.json says", folder, result.lights.size(),
                                     result.blocks->first, result.blocks->second));
    return result;
}

Estimate read_light(const std::string& path) { return read_rendered_picture(path).picture; }

Regions read_regions(const std::string& path) {
    const Image image = read_other_picture(path, std::nullopt);
    Regions regions{image.width, image.height, {}};
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double value = image.at(x, y).x;
            if (!(value >= 0.0 && value < 1e6 && value == std::floor(value)))
                throw InputError(
                    fmt::format("{}: pixel ({}, {}) is {:g}, expected the number of its light, 1 and up, or 0", path, x, y, value));
            regions.of_pixel.push_back(static_cast<int>(value) - 1);
        }
    return regions;
}

void write_light_renders(OutputFolder& folder, const LightRenders& renders) {
    const auto write = [&](const char* name, const char* quantity, const Estimate& picture, std::size_t number) {
        Attributes attributes = attributes_of(quantity, number);
        attributes["neumann:degrees_of_freedom"] = picture.degrees_of_freedom;
        folder.write(numbered(name, number), encode_exr(picture, attributes));
    };
    for (std::size_t j = 0; j < renders.pictures.size(); ++j) {
        write("light", "L of one light", renders.pictures[j], j);
        write("direct", "K Le of one light", renders.direct_of(j), j);
    }
    for (std::size_t i = 0; i < renders.forward.size(); ++i) write("forward", "K^i Le of all lights", renders.forward[i], i + 1);
}

void write_unbounced(OutputFolder& folder, const Unbounced& found, const std::vector<Estimate>& forward) {
    const Image black(found.picture.width, found.picture.height);
    const double exposure = exposure_for(found.picture, black);
    Strip strip(forward.empty() ? 1 : 2);
    const std::size_t shown = std::min({found.terms.size(), most_shown, forward.empty() ? most_shown : forward.size()});
    for (std::size_t n = 0; n < found.terms.size(); ++n) {
        folder.write(numbered("backward", n + 1), term_exr(found, n));
        if (n >= shown) continue;
        const Image& reference = forward.empty() ? found.terms[n].mean : forward[n].mean;
        // The factor is rounded down to a power of two, as in the strips of a render.
        const double factor = std::max(1.0, std::exp2(std::floor(std::log2(exposure_for(reference, black) / exposure) + 1e-3)));
        const std::string times = factor == 1.0 ? "" : fmt::format("{:g} ", factor);
        strip[0].push_back({fmt::format("{}C{} L", times, superscript(n + 1)), &found.terms[n].mean, factor});
        if (!forward.empty()) strip[1].push_back({fmt::format("{}K{} Le", times, superscript(n + 1)), &forward[n].mean, factor});
    }
    PixelEstimate rest;
    rest.mean = found.rest;
    folder.write("backward_rest.exr", encode_exr(rest, attributes_of("L less the terms", found.terms.size())));
    folder.write("unbounced.png", strip_png(strip, exposure, find_label_font()));
}

Json unbounce_json(const Unbounced& found, const std::vector<std::string>& names, const std::vector<TermAgreement>& forward,
                   const std::vector<Doubt>& doubts) {
    Json json{{"lights", names}, {"errors_known", found.knows_errors}, {"channels", Json::array()}, {"bounces", Json::array()}};
    constexpr const char* channels[] = {"r", "g", "b"};
    for (std::size_t c = 0; c < 3; ++c) json["channels"].push_back(channel_json(found.channels[c], channels[c]));
    for (std::size_t n = 0; n < found.terms.size(); ++n) {
        Json bounce{{"bounce", n + 1}, {"backward", mean_and_stderr(found.means[n].all)}};
        if (!found.discretisation.empty()) bounce["backward"]["discretisation"] = json_number(found.discretisation[n]);
        if (n < forward.size()) {
            const TermAgreement& term = forward[n];
            bounce["forward"] = mean_and_stderr(term.forward);
            bounce["difference"] = mean_and_stderr(term.difference);
            bounce["difference"]["in_errors"] = json_number(term.deviations());
            if (term.by_way_of_unseen) bounce["by_way_of_unseen"] = mean_and_stderr(*term.by_way_of_unseen);
            bounce["regions"] = {{"relative_difference", json_number(term.relative_difference)},
                                 {"by_noise", json_number(term.by_noise)}};
        }
        json["bounces"].push_back(bounce);
    }
    json["doubts"] = Json::array();
    for (const Doubt& doubt : doubts) json["doubts"].push_back({{"kind", name_of(doubt.kind)}, {"words", doubt.words}});
    return json;
}

}  // namespace neumann
