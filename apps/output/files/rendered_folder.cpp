#include "apps/output/files/rendered_folder.h"

#include "apps/output/files/output_folder.h"
#include "apps/output/files/rendered_picture.h"
#include "apps/output/files/scene_json.h"
#include "apps/output/files/series_files.h"
#include "core/base/error.h"
#include "core/base/input_file.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

namespace neumann {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json read_run(const fs::path& path) {
    Json run;
    try {
        std::ifstream file = open_if_there(path);
        if (!file && fs::exists(path.parent_path() / unfinished_render_file))
            throw InputError(fmt::format("{0}: holds a render that was not finished; neumann render --resume {0} goes on with it",
                                         path.parent_path().string()));
        if (!file) throw InputError(path.string() + ": cannot be read; expected a folder that render wrote");
        run = Json::parse(file);
        for (const char* part :
             {"command", "scene", "picture", "quantity", "options", "samples", "timing", "sum", "bounces", "rest", "warnings"})
            static_cast<void>(run.at(part));
        for (const char* side : {"width", "height"}) static_cast<void>(run["picture"].at(side).get<int>());
        static_cast<void>(run["quantity"].at("name").get<std::string>());
        if (run["bounces"].empty()) throw InputError(path.string() + ": no bounces");
    } catch (const Json::exception& error) {
        throw InputError(fmt::format("{}: not a run.json of this version: {}", path.string(), error.what()));
    }
    return run;
}

}  // namespace

RenderedFolder::RenderedFolder(const std::string& folder)
    : path_(folder), run_(read_run(path_ / "run.json")), size_{run_["picture"].at("width"), run_["picture"].at("height")} {}

bool RenderedFolder::has_rest() const { return fs::exists(path_ / "rest.exr"); }

PixelEstimate RenderedFolder::picture(const std::string& name) const {
    const fs::path path = path_ / name;
    RenderedPicture read = read_rendered_picture(path.string());
    const Image& mean = read.picture.mean;
    if (Size{mean.width, mean.height} != size_)
        throw InputError(
            fmt::format("{}: {}×{} pixels, expected {}×{}", path.string(), mean.width, mean.height, size_.width, size_.height));
    return std::move(read.picture);
}

ShownSeries RenderedFolder::series() const {
    ShownSeries series;
    series.bounces = bounces();
    series.has_rest = has_rest();
    series.is_importance = run_["quantity"].at("name").get<std::string>().starts_with("importance");
    series.is_subset = run_.value("paths", "all") != "all";
    series.width = size_.width;
    series.height = size_.height;
    const auto replaced = run_["scene"].value("replaced", std::vector<std::string>());
    series.lenient_label = lenient_label(replaced);
    series.lenient_note = lenient_note(replaced);
    series.term = [this](std::size_t i) { return picture(i == bounces() ? "rest.exr" : bounce_file(i)); };
    series.sum = [this](std::size_t i) { return picture(sum_file(i)); };
    return series;
}

std::optional<std::string> RenderedFolder::text(const std::string& name) const {
    std::ifstream file = open_if_there(path_ / name);
    if (!file) return std::nullopt;
    std::ostringstream text;
    if (!(text << file.rdbuf())) throw InputError((path_ / name).string() + ": cannot be read");
    return text.str();
}

}  // namespace neumann
