#include "apps/output/rendering_files.h"

#include "apps/output/files/health_json.h"
#include "apps/output/files/json_text.h"
#include "apps/output/files/series_figures.h"
#include "apps/output/files/series_files.h"
#include "apps/output/files/ways_files.h"
#include "apps/output/pages/explorer_page.h"
#include "apps/output/pages/paths_json.h"
#include "apps/output/pages/touch_page.h"
#include "apps/output/run_json.h"
#include "core/base/error.h"
#include "core/base/stopwatch.h"

#include <filesystem>

namespace neumann {

namespace {

PackedSeries packed_for_page(const Rendering& rendering) {
    const Film& film = rendering.scene->film;
    const BounceSeries& series = rendering.series;
    return {film.crop_width, film.crop_height, series.report.bounces.size() + (series.rest ? 1 : 0)};
}

}  // namespace

Warnings Rendering::warnings() const {
    Warnings all = scene->warnings;
    for (const auto& [text, count] : series.warnings.counts()) all.add(text, count);
    return all;
}

std::vector<std::string> Rendering::complaints(const std::string& folder) const {
    return neumann::complaints(series, *scene, folder);
}

std::string page_data(const Rendering& rendering, bool is_under_way) {
    const BounceSeries& series = rendering.series;
    ExploredRun explored{run_json(rendering, rendering.warnings(), "", rendering.seconds), convergence_table(series.convergence),
                         1.0, packed_for_page(rendering), series.rest.has_value()};
    explored.is_under_way = is_under_way;
    if (is_under_way) explored.run["samples"]["outcome"] = "under way";
    explored.exposure = pack_pictures(series, *rendering.scene, explored.pictures);
    return explorer_data({&explored});
}

WrittenRendering write_rendering(const Rendering& rendering, OutputFolder& folder) {
    const Stopwatch watch;
    const BounceSeries& series = rendering.series;
    Warnings warnings = rendering.warnings();
    PackedSeries packed = packed_for_page(rendering);
    const ChosenFiles& files = rendering.files;
    const ShownPictures written = write_pictures(folder, series, files, *rendering.scene, packed);
    if (!written.warning.empty()) warnings.add(written.warning);
    if (files.page && packed.factor() > 1) warnings.add(packed.reduction());
    if (files.layers) write_layers(folder, series, *rendering.scene);
    if (series.ways) write_ways(folder, *series.ways, files);
    const std::string convergence = convergence_table(series.convergence);
    if (files.tables) {
        folder.write("series.csv", series_table(series.report));
        folder.write("convergence.csv", convergence);
    }
    if (files.figures) write_figures(folder, series.report);
    const auto json = run_json(rendering, warnings, folder.path().string(), rendering.seconds + watch.seconds());
    std::string data, why_no_paths;
    if (files.page) {
        ExploredRun explored{json, convergence, written.exposure, std::move(packed), series.rest.has_value()};
        if (!rendering.paths.empty()) try {
                const RecordedRun run = recorded_run(series, rendering.request.scene, *rendering.scene, folder.path().string());
                explored.paths = paths_json(run, *rendering.scene, rendering.paths);
            } catch (const InputError& error) {  // the render must not be lost for this
                why_no_paths = error.what();
            }
        data = explorer_data({&explored});
        folder.write("index.html", explorer_page(data));
    }
    if (files.touch) {
        const auto separated =
            rendering.separated ? rendering.separated : std::make_shared<const SeparatedScene>(separate(*rendering.scene, {}));
        const std::string name = std::filesystem::path(rendering.request.scene.path).stem().string();
        folder.write("touch.html", touch_page(*separated, series, name));
    }
    folder.write("run.json", json_text(json, 2) + "\n");
    folder.commit();
    return {warnings, json, std::move(data), std::move(why_no_paths)};
}

}  // namespace neumann
