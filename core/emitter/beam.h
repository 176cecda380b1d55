// The light that a light without extent sends to a point, and the scene data that such lights need.
#pragma once

#include "core/base/vec.h"

namespace neumann {

// The light that arrives at a point.
struct Beam {
    Vec3 from;            // position of the light; if it is infinitely far away, a point beyond the scene
    Rgb irradiance{0.0};  // on a surface perpendicular to the beam, W·m⁻²
};

// The sphere around a scene.
struct Surroundings {
    Vec3 center{0.0};
    double radius = 1.0;
};

}  // namespace neumann
