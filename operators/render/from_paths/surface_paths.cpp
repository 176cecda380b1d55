#include "operators/render/from_paths/surface_paths.h"

#include "operators/render/from_paths/term_estimators.h"

namespace neumann {

std::shared_ptr<const PathSampler> SurfacePaths::sampler(const Scene& scene, const SamplingSettings& settings) const {
    return walk_sampler(scene, settings, SurfaceContinuation(scene.geometry));
}

Paths SurfacePaths::paths(const Scene& scene) const { return has_specular(scene.materials) ? Paths::without_specular : Paths::all; }

void SurfacePaths::warn(const Scene& scene, Warnings& warnings) const {
    PathMethod::warn(scene, warnings);
    if (paths(scene) == Paths::without_specular)
        warnings.add(
            "surface makes no path by way of a mirror, of glass or of anything else that sends light in a single "
            "direction: what these reflect and let through is missing");
    warnings.add("where surfaces meet at an angle, the variance of surface is infinite, even if the samples do not show it");
}

}  // namespace neumann
