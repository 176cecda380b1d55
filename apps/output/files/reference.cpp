#include "apps/output/files/reference.h"

#include "apps/output/files/series_files.h"
#include "core/base/error.h"
#include "core/base/input_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

namespace neumann {

RenderedPicture read_reference(const std::string& folder, const std::string& file, const Film& film) {
    const std::string path = (std::filesystem::path(folder) / file).string();
    RenderedPicture rendered = read_rendered_picture(path);
    const Image& image = rendered.picture.mean;
    if (image.width != film.crop_width || image.height != film.crop_height)
        throw InputError(fmt::format("{}: is {}×{} pixels, expected {}×{} as the scene's film", path, image.width, image.height,
                                     film.crop_width, film.crop_height));
    return rendered;
}

Reference::Reference(const std::string& folder, int bounces, const Film& film) {
    if (!std::filesystem::is_directory(folder))
        throw InputError(folder + ": is not a folder; --reference takes the folder of an earlier render");
    for (int i = 0; i <= bounces; ++i)
        terms_.push_back(read_reference(folder, bounce_file(static_cast<std::size_t>(i)), film).picture.mean);
    sum_ = read_reference(folder, sum_file(static_cast<std::size_t>(bounces)), film).picture.mean;
}

void Reference::judge(const std::function<Image(std::size_t)>& term, const Image& sum, Checkpoint& checkpoint) const {
    for (std::size_t i = 0; i < terms_.size(); ++i) checkpoint.true_term_error.push_back(relative_error(term(i), terms_[i]));
    checkpoint.true_sum_error = relative_error(sum, sum_);
}

void warn_of_reference(const std::string& folder, const BounceSeries& series, Warnings& warnings) {
    std::ifstream file = open_if_there(std::filesystem::path(folder) / "run.json");
    const auto run = nlohmann::json::parse(file, nullptr, false);
    if (run.is_discarded()) return;
    const auto is = [&](const char* part, const nlohmann::json& value) {
        const nlohmann::json::json_pointer at(part);
        return run.contains(at) && run.at(at) == value;
    };
    if (is("/options/seed", series.seed) && is("/options/method", name_of(series.method)))
        warnings.add("the reference has the same seed and method, so that samples are shared: errors against it are too small");
    if (run.contains("paths") && !is("/paths", "all")) warnings.add("the reference has a subset of all paths");
    if (run.contains("quantity") && is("/quantity/unit", "m^-2 sr^-1") != series.report.importance)
        warnings.add("the reference is of another quantity: radiance against importance");
}

}  // namespace neumann
