#include "apps/pages/compare_page.h"

#include "apps/files/output_folder.h"
#include "apps/files/rendered_picture.h"
#include "apps/files/series_files.h"
#include "apps/pages/explorer_page.h"
#include "core/base/error.h"
#include "core/image/display.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace neumann {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string text_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    if (!file || !(text << file.rdbuf())) throw InputError(path.string() + ": cannot be read; -o takes folders that render wrote");
    return text.str();
}

// Throws InputError if run.json lacks something that the page shows.
Json read_run(const fs::path& path) {
    Json run;
    try {
        run = Json::parse(text_of(path));
        for (const char* part :
             {"command", "scene", "picture", "quantity", "options", "samples", "timing", "sum", "bounces", "rest", "warnings"})
            static_cast<void>(run.at(part));
        for (const char* side : {"width", "height"}) static_cast<void>(run["picture"].at(side).get<int>());
        if (run["bounces"].empty()) throw InputError(path.string() + ": no bounces");
    } catch (const Json::exception& error) {
        throw InputError(fmt::format("{}: not a run.json of this version: {}", path.string(), error.what()));
    }
    return run;
}

struct Size {
    int width, height;
    auto operator<=>(const Size&) const = default;
};

PixelEstimate read_picture(const fs::path& path, Size size) {
    RenderedPicture read = read_rendered_picture(path.string());
    const Image& mean = read.picture.mean;
    if (Size{mean.width, mean.height} != size)
        throw InputError(
            fmt::format("{}: {}×{} pixels, expected {}×{}", path.string(), mean.width, mean.height, size.width, size.height));
    return std::move(read.picture);
}

struct RenderedFolder {
    fs::path path;
    Json run;
    Size size;

    explicit RenderedFolder(const std::string& folder)
        : path(folder), run(read_run(path / "run.json")), size{run["picture"].at("width"), run["picture"].at("height")} {}
    std::size_t bounces() const { return run["bounces"].size(); }
    bool has_rest() const { return fs::exists(path / "rest.exr"); }
    std::size_t pictures() const { return bounces() + (has_rest() ? 1 : 0); }
};

// Reads a run for the page; pictures are reduced so that `pictures` of them fit.
ExploredRun explored(const RenderedFolder& folder, std::size_t pictures) {
    ExploredRun out{folder.run, text_of(folder.path / "convergence.csv"), 1.0,
                    PackedSeries(folder.size.width, folder.size.height, folder.pictures(), pictures), folder.has_rest()};
    const bool importance = folder.run["quantity"].value("name", "").starts_with("importance");
    Image emission;
    for (std::size_t i = 0; i < folder.bounces(); ++i) {
        PixelEstimate term = read_picture(folder.path / bounce_file(i), folder.size);
        const PixelEstimate sum = read_picture(folder.path / sum_file(i), folder.size);
        out.pictures.add_term(i, term);
        out.pictures.add_sum(i, sum);
        if (i == 0) emission = std::move(term.mean);
        if (i + 1 == folder.bounces()) out.exposure = exposure_for(sum.mean, importance ? sum.mean : emission);
    }
    if (out.has_rest) out.pictures.add_term(folder.bounces(), read_picture(folder.path / "rest.exr", folder.size));
    out.pictures.pack();
    return out;
}

}  // namespace

void write_compare_page(const std::string& output, const std::vector<std::string>& folders, const Json& figures) {
    const std::vector<RenderedFolder> rendered(folders.begin(), folders.end());
    std::size_t pictures = 0;
    for (const RenderedFolder& folder : rendered) {
        const Size expected = rendered.front().size;
        if (folder.size != expected)
            throw InputError(fmt::format("{} and {}: {}×{} and {}×{} pixels; expected one size", folders.front(),
                                         folder.path.string(), expected.width, expected.height, folder.size.width,
                                         folder.size.height));
        pictures += folder.pictures();
    }
    OutputFolder folder(output, "compare");
    std::vector<ExploredRun> runs;
    std::vector<const ExploredRun*> shown;
    for (const RenderedFolder& read : rendered) runs.push_back(explored(read, pictures));
    for (const ExploredRun& run : runs) shown.push_back(&run);
    if (runs.front().pictures.factor() > 1) fmt::print(stderr, "note: {}\n", runs.front().pictures.reduction());
    folder.write("index.html", explorer_page(shown, figures));
    folder.write("compare.json", figures.dump(2) + "\n");
    folder.commit();
}

}  // namespace neumann
