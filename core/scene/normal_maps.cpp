#include "core/scene/normal_maps.h"

namespace neumann {

bool has_normal_maps(const Scene& scene) {
    for (std::uint32_t shape = 0; shape < scene.geometry.shapes().size(); ++shape)
        for (const bool front : {true, false})
            if (const Bsdf* bsdf = scene.materials.at(shape, front); bsdf && std::holds_alternative<PerturbedNormal>(*bsdf))
                return true;
    return false;
}

}  // namespace neumann
