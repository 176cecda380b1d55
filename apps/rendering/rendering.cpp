#include "apps/rendering/rendering.h"

#include "apps/pages/explorer_page.h"
#include "apps/files/run_json.h"
#include "apps/files/series_files.h"
#include "core/base/stopwatch.h"

namespace neumann {

Warnings Rendering::warnings() const {
    Warnings all = scene.warnings;
    for (const auto& [text, count] : result.warnings.counts()) all.add(text, count);
    return all;
}

std::vector<std::string> Rendering::complaints(const std::string& folder) const {
    if (!result.health) return {};
    return result.health(folder).at("complaints").get<std::vector<std::string>>();
}

std::unique_ptr<Rendering> render(const RenderRequest& request, Scene scene,
                                  const std::function<void(int, const RenderProgress&)>& progress,
                                  const std::function<void(int)>& chosen) {
    const Stopwatch watch;
    Pilot pilot(scene, direct_light(request.light, scene.emitters), request.seed);
    Plan plan = plan_of(request, scene);
    leave_out(plan, scene);
    std::unique_ptr<Rendering> rendering(new Rendering{request, std::move(scene), std::move(pilot), std::move(plan), {}});
    RenderJob job = rendering->job();
    job.progress = progress;
    job.chosen = chosen;
    rendering->result = render_by_method(job);
    rendering->seconds = watch.seconds();
    return rendering;
}

WrittenRendering write_rendering(const Rendering& rendering, OutputFolder& folder) {
    const Stopwatch watch;
    const RenderResult& result = rendering.result;
    const BounceSeries& series = result.series;
    const Film& film = rendering.scene.film;
    Warnings warnings = rendering.warnings();
    PackedSeries packed(film.crop_width, film.crop_height, series.report.bounces.size() + (series.rest ? 1 : 0));
    const WrittenPictures written = write_pictures(folder, series, packed);
    if (!written.warning.empty()) warnings.add(written.warning);
    if (packed.factor() > 1) warnings.add(packed.reduction());
    if (result.ways) write_ways(folder, *result.ways);
    folder.write("series.csv", series_table(series.report));
    const std::string convergence = convergence_table(series.convergence);
    folder.write("convergence.csv", convergence);
    const auto json = run_json(rendering.job(), result, warnings, folder.path().string(), rendering.seconds + watch.seconds());
    const ExploredRun explored{json, convergence, written.exposure, std::move(packed), series.rest.has_value()};
    folder.write("index.html", explorer_page({&explored}));
    folder.write("run.json", json.dump(2) + "\n");
    folder.commit();
    return {warnings, json};
}

}  // namespace neumann
