#include "apps/commands/page_command.h"

#include "apps/output/files/rendered_folder.h"
#include "apps/output/files/series_files.h"
#include "apps/output/files/ways_files.h"
#include "apps/output/pages/explorer_page.h"
#include "apps/output/pages/paths_json.h"
#include "core/base/error.h"
#include "core/base/limits.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace neumann {

namespace {

std::string theme_of(const RenderedFolder& rendered) {
    const auto request = rendered.run().find("request");
    if (request == rendered.run().end()) return "dark";
    // The first form is that of version 0.1, the second the present one.
    return request->contains("--theme") ? request->at("--theme").at(0).get<std::string>() : request->value("theme", "dark");
}

nlohmann::ordered_json paths_of(const std::string& folder, const ChosenPixels& chosen) {
    if (chosen.empty()) return nullptr;
    const RecordedRun run = read_recorded_run(folder);
    return paths_json(run, read_scene_of(run), chosen);
}

}  // namespace

int page_command(const PageRequest& request) try {
    const ThreadLimit threads(request.threads);
    const RenderedFolder rendered(request.folder);
    ChosenFiles files = choose_files(request.files);
    files.white = (request.theme.empty() ? theme_of(rendered) : request.theme) == "white";
    const auto paths = paths_of(request.folder, choose_pixels(request.paths, files));

    OutputFolder folder(request.folder, "render");
    std::vector<std::string> notes;
    PackedSeries packed(rendered.size().width, rendered.size().height, rendered.pictures());
    ShownPictures shown;
    if (files.page || files.sheets || files.strips) shown = show_series(folder, rendered.series(), files, packed);
    if (!shown.warning.empty()) notes.push_back(shown.warning);
    if (files.strips && rendered.run().at("samples").contains("mixture"))
        notes.emplace_back("strip-mixture.png is not made: no file has the weights that it shows");
    if (files.sheets) write_sheet_of_ways(folder, rendered);
    const auto convergence = rendered.text("convergence.csv");
    if (!convergence && files.page)
        notes.emplace_back("there is no convergence.csv, which nothing else holds: the page shows no errors against time");
    if (files.page) {
        if (packed.factor() > 1) notes.push_back(packed.reduction());
        const ExploredRun explored{rendered.run(),    convergence.value_or(""), shown.exposure,
                                   std::move(packed), rendered.has_rest(),      paths};
        folder.write("index.html", explorer_page({&explored}));
    }
    const std::vector<std::string> written = folder.add_to_others();
    if (request.quiet) return 0;
    for (const std::string& note : notes) fmt::print(stderr, "note: {}\n", note);
    fmt::print("New in {}: {}\n", request.folder, fmt::join(written, ", "));
    return 0;
} catch (const nlohmann::ordered_json::exception& error) {
    throw InputError(fmt::format("{}/run.json: not a run.json of this version: {}", request.folder, error.what()));
}

}  // namespace neumann
