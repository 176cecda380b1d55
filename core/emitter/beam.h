// What a light without extent sends to a point, and what such lights have to know of the scene.
#pragma once

#include "core/base/vec.h"

namespace neumann {

// What arrives at a point from such a light.
struct Beam {
    Vec3 from;            // a point of the light; of one infinitely far away, beyond the scene
    Rgb irradiance{0.0};  // per area across the beam, W·m⁻²
};

// The sphere around a scene.
struct Surroundings {
    Vec3 center{0.0};
    double radius = 1.0;
};

}  // namespace neumann
