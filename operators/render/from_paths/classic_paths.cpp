#include "operators/render/from_paths/classic_paths.h"

#include "operators/render/from_paths/term_estimators.h"

namespace neumann {

std::shared_ptr<const PathSampler> ClassicPaths::sampler(const Scene& scene, const SamplingSettings& settings) const {
    return walk_sampler(scene, settings, SpecularContinuation());
}

void ClassicPaths::warn(const Scene& scene, Warnings& warnings) const {
    PathMethod::warn(scene, warnings);
    warnings.add(
        "classic makes only paths whose reflections are specular but for the last one: the light of all other paths is "
        "missing");
}

}  // namespace neumann
