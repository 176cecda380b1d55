#include "core/scene/shading_normals.h"

namespace neumann {

bool has_shading_normals(const Scene& scene) {
    const auto& shapes = scene.geometry.shapes();
    for (std::uint32_t shape = 0; shape < shapes.size(); ++shape) {
        if (has_smooth_normals(shapes[shape])) return true;
        for (const bool front : {true, false})
            if (const Bsdf* bsdf = scene.materials.at(shape, front); bsdf && std::holds_alternative<PerturbedNormal>(*bsdf))
                return true;
    }
    return false;
}

}  // namespace neumann
