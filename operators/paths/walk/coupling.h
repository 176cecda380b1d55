// The coupling of two points on diffuse surfaces, without visibility:
//
//     g(x, y) = cosθx cosθy / (π d²),   per area at y; 0 if either is behind the other
//
// Light that y sends out in all directions alike arrives at x and leaves it again with ρ g V. g is also the density,
// per area, with which a direction that is sampled by its cosine at x finds y.
#pragma once

#include "core/base/vec.h"

namespace neumann {

inline double coupling(const Vec3& x, const Vec3& nx, const Vec3& y, const Vec3& ny) {
    const Vec3 d = y - x;
    const double a = glm::dot(nx, d), b = -glm::dot(ny, d);
    if (!(a > 0.0) || !(b > 0.0)) return 0.0;
    const double d2 = glm::dot(d, d);
    return a * b * inv_pi / (d2 * d2);
}

}  // namespace neumann
