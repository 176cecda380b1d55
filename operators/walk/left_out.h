// What walks need not do in a scene of which it was shown (operators/plan) that it changes nothing: neither the expected picture
// nor, but for `questions`, its bits. Without being told so they do everything.
#pragma once

#include "core/geometry/surface_point.h"

namespace neumann {

struct LeftOut {
    // V(x, y) = 1 for points x and y of surfaces that are not in one plane: all surfaces lie on the boundary of a convex body.
    bool shadow_rays_in_room = false;
    // No side that reflects sees a surface: what leaves it meets none, and what lights it from above its horizon is in sight.
    bool rays_from_surfaces = false;
    // No ray meets a light: the ray after the last bounce is for the rest alone.
    bool rays_for_light = false;
    // The directions of materials find light that is the same everywhere: lights are not asked, where they would be asked and hit.
    bool questions = false;
};

// x and y, on a convex body's boundary, see each other and are told apart by more than the rounding of a hit.
inline bool see_through_room(const SurfacePoint& x, const SurfacePoint& y) {
    const Vec3 d = y.position - x.position;
    const double rounding = x.error + y.error;
    return std::abs(glm::dot(x.normal, d)) > rounding && std::abs(glm::dot(y.normal, d)) > rounding;
}

// V(x, y) = 1 is known without a ray.
inline bool is_in_sight(const LeftOut& left_out, const SurfacePoint& x, const SurfacePoint& y) {
    return (left_out.rays_from_surfaces && y.is_infinite()) || (left_out.shadow_rays_in_room && see_through_room(x, y));
}

}  // namespace neumann
