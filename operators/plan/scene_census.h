// What is in a scene, counted.
#pragma once

#include "core/scene/scene.h"

namespace neumann {

struct SceneCensus {
    explicit SceneCensus(const Scene& scene);

    std::size_t shapes = 0, smooth = 0;  // `smooth`: shapes with shading normals, of the mesh or of a map
    // Sides of shapes with a material, and of these: that change over the surface, mirror or throw light
    // in single directions otherwise, spread it around such a direction, let it through, or are holes in parts.
    std::size_t sides = 0, textured = 0, specular = 0, rough = 0, transmissive = 0, masked = 0;
    std::size_t light_shapes = 0;  // shapes that give off light
    bool has_environment = false, has_constant_environment = false, has_delta_lights = false;
    bool is_grey = false;
    // All shapes give off one radiance, and so does what surrounds them, if anything does.
    bool shines_alike = false;
};

}  // namespace neumann
