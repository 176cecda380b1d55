// Counts the contents of a scene.
#pragma once

#include "core/scene/scene.h"

namespace neumann {

struct SceneCensus {
    explicit SceneCensus(const Scene& scene);

    std::size_t shapes = 0, smooth = 0;  // `smooth`: shapes with shading normals, of the mesh or of a map
    // Numbers of sides of shapes with a material, and of sides whose material varies over the surface, has a delta lobe, has a
    // glossy lobe, transmits light, or is masked by holes.
    std::size_t sides = 0, textured = 0, specular = 0, rough = 0, transmissive = 0, masked = 0;
    std::size_t light_shapes = 0;  // shapes that emit
    bool has_environment = false, has_constant_environment = false, has_delta_lights = false;
    bool is_grey = false;
    // Whether all shapes emit the same constant radiance, and the environment too, if there is one.
    bool shines_alike = false;
};

}  // namespace neumann
