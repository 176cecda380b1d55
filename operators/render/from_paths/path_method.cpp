#include "operators/render/from_paths/path_method.h"

#include "operators/render/from_paths/allocation.h"

#include <algorithm>

namespace neumann {

std::shared_ptr<const Allocation> PathMethod::allocate(const Scene& scene, const SamplingSettings& settings, LeastError least,
                                                       const Watch& watch) const {
    return neumann::allocate(scene, settings, least, watch);
}

const char* PathMethod::unfound_in_mirrors() const {
    return "what a mirror throws on from a light without extent is not found by the walk and is missing";
}

void PathMethod::warn(const Scene& scene, Warnings& warnings) const {
    if (const char* const unfound = unfound_in_mirrors();
        unfound != nullptr && scene.emitters.has_delta_lights() && has_specular(scene.materials))
        warnings.add(unfound);
}

}  // namespace neumann
