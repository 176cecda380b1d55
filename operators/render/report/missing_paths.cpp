#include "operators/render/report/missing_paths.h"

#include <algorithm>

namespace neumann {

bool has_specular(const Materials& materials) {
    const auto& bsdfs = materials.bsdfs();
    return std::any_of(bsdfs.begin(), bsdfs.end(), [](const Bsdf& b) { return lobe(b).kind == Lobe::Kind::specular; });
}

Paths paths_of(PathGenerator generator, const Scene& scene) {
    if (generator == PathGenerator::classic) return Paths::specular;
    if (generator == PathGenerator::light && (has_specular(scene.materials) || scene.emitters.has_environment()))
        return Paths::seen_directly;
    return generator == PathGenerator::surface && has_specular(scene.materials) ? Paths::without_specular : Paths::all;
}

void report_missing(SeriesReport& report, const Pilot& pilot) {
    const std::size_t known = std::min(report.bounces.size(), static_cast<std::size_t>(pilot.bounces()) + 1);
    for (std::size_t i = 0; i < known; ++i)
        report.bounces[i].missing = difference(pilot.term(static_cast<int>(i)), report.bounces[i].mean);
}

}  // namespace neumann
