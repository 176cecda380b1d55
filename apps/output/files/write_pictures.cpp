#include "apps/output/files/scene_json.h"
#include "apps/output/files/series_files.h"
#include "apps/output/files/shown_series.h"
#include "core/image/in_file.h"
#include "operators/render/from_paths/mixed_sampler.h"

namespace neumann {

namespace {

ShownSeries shown_series(const BounceSeries& series, const Scene& scene) {
    const auto* paths = std::get_if<PathRecord>(&series.record);
    const auto* mixed = paths ? as<MixedPaths>(paths->path_method) : nullptr;
    const std::size_t bounces = series.report.bounces.size();
    return {bounces,
            series.rest.has_value(),
            series.report.importance,
            series.paths != Paths::all,
            scene.film.crop_width,
            scene.film.crop_height,
            lenient_label(scene),
            lenient_note(scene),
            mixed ? &mixed->mixture() : nullptr,
            [&series, bounces](std::size_t i) { return as_in_file(i == bounces ? *series.rest : series.term(i)); },
            [&series](std::size_t i) { return as_in_file(series.sum(i)); }};
}

}  // namespace

double pack_pictures(const BounceSeries& series, const Scene& scene, PackedSeries& packed) {
    return pack_series(shown_series(series, scene), packed);
}

ShownPictures write_pictures(OutputFolder& folder, const BounceSeries& series, const ChosenFiles& files, const Scene& scene,
                             PackedSeries& packed) {
    if (!files.pictures && !files.page && !files.sheets && !files.strips) return {};
    ShownSeries shown = shown_series(series, scene);
    if (files.pictures) {
        // Each picture is estimated once, for its file and for display.
        shown.term = [&](std::size_t i) {
            if (i == series.report.bounces.size()) {
                folder.write("rest.exr", rest_exr(series, scene));
                return as_in_file(*series.rest);
            }
            PixelEstimate term = series.term(i);
            folder.write(bounce_file(i), term_exr(series, scene, i, term));
            return as_in_file(std::move(term));
        };
        shown.sum = [&](std::size_t i) {
            PixelEstimate sum = series.sum(i);
            folder.write(sum_file(i), sum_exr(series, scene, i, sum));
            return as_in_file(std::move(sum));
        };
    }
    return show_series(folder, shown, files, packed);
}

}  // namespace neumann
