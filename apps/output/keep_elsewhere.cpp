// Keeps the results of a render if the output disk is full.
#include "apps/output/rendering_files.h"

#include "apps/output/files/series_files.h"
#include "core/base/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <filesystem>
#include <optional>

namespace neumann {

namespace {

namespace fs = std::filesystem;

// A new temporary folder, if this many bytes are free there.
std::optional<fs::path> temporary_folder(double bytes) {
    std::error_code error;
    const fs::path all = fs::temp_directory_path(error);
    if (error) return std::nullopt;
    const fs::space_info space = fs::space(all, error);
    std::string name = (all / "neumann-XXXXXX").string();
    if (error || static_cast<double>(space.available) < bytes || ::mkdtemp(name.data()) == nullptr) return std::nullopt;
    return name;
}

// "out/x-incomplete" or, if that exists, "out/x-incomplete-2" ….
fs::path folder_beside(fs::path output) {
    if (!output.has_filename()) output = output.parent_path();
    const std::string first = output.string() + "-incomplete";
    std::error_code error;
    for (int i = 1;; ++i) {
        const fs::path path = i == 1 ? first : fmt::format("{}-{}", first, i);
        if (!fs::exists(path, error)) return path;
    }
}

}  // namespace

std::string keep_elsewhere(const Rendering& rendering, const std::string& output) {
    const BounceSeries& series = rendering.series;
    if (const auto path =
            temporary_folder(estimated_bytes(rendering.scene->film, series.bounces(), is_biased(series.method), rendering.files))) {
        try {
            OutputFolder folder(*path, "render");
            write_rendering(rendering, folder);
            return fmt::format("All of it is in {} instead; move it to where it is to stay", path->string());
        } catch (const std::exception&) {  // that disk is full, too
            std::error_code error;
            fs::remove(*path, error);
        }
    }
    const fs::path path = folder_beside(output);
    try {
        OutputFolder folder(path, "render");
        const std::vector<std::string> missing = write_terms_that_fit(folder, series, *rendering.scene);
        if (missing.size() < static_cast<std::size_t>(series.bounces()) + 1) {
            folder.commit();
            return fmt::format("What fits is in {}: the bounces, the rest and series.csv{}{}", path.string(),
                               missing.empty() ? "" : " without ", fmt::join(missing, " "));
        }
    } catch (const std::exception&) {  // nothing more can be done
    }
    return "Nothing of it could be written elsewhere";
}

}  // namespace neumann
