#include "apps/output/pages/compare_page.h"

#include "apps/output/files/json_text.h"
#include "apps/output/files/rendered_folder.h"
#include "apps/output/pages/explorer_page.h"
#include "core/base/error.h"

#include <fmt/format.h>

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;

// The pictures are reduced so that `pictures` of them fit on a page.
ExploredRun explored(const RenderedFolder& rendered, std::size_t pictures, OutputFolder& folder) {
    const auto convergence = rendered.text("convergence.csv");
    if (!convergence)
        throw InputError((rendered.path() / "convergence.csv").string() + ": cannot be read; expected a folder that render wrote");
    PackedSeries packed(rendered.size().width, rendered.size().height, rendered.pictures(), pictures);
    const ShownPictures shown = show_series(folder, rendered.series(), choose_files({"page"}), packed);
    return {rendered.run(), *convergence, shown.exposure, std::move(packed), rendered.has_rest()};
}

}  // namespace

void write_compare_page(const std::string& output, const std::vector<std::string>& folders, const Json& figures) {
    const std::vector<RenderedFolder> rendered(folders.begin(), folders.end());
    std::size_t pictures = 0;
    for (const RenderedFolder& folder : rendered) {
        const RenderedFolder::Size expected = rendered.front().size();
        if (folder.size() != expected)
            throw InputError(fmt::format("{} and {}: {}×{} and {}×{} pixels; expected one size", folders.front(),
                                         folder.path().string(), expected.width, expected.height, folder.size().width,
                                         folder.size().height));
        pictures += folder.pictures();
    }
    OutputFolder folder(output, "compare");
    std::vector<ExploredRun> runs;
    std::vector<const ExploredRun*> shown;
    for (const RenderedFolder& read : rendered) runs.push_back(explored(read, pictures, folder));
    for (const ExploredRun& run : runs) shown.push_back(&run);
    if (runs.front().pictures.factor() > 1) fmt::print(stderr, "note: {}\n", runs.front().pictures.reduction());
    folder.write("index.html", explorer_page(shown, figures));
    folder.write("compare.json", json_text(figures, 2) + "\n");
    folder.commit();
}

}  // namespace neumann
