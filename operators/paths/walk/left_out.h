// Work that walks leave out because the plan (operators/render/plan) has shown that it does not change the expected
// picture. Except for `light_samples`, the picture has the same bits. By default nothing is left out.
#pragma once

#include "core/geometry/surface_point.h"

namespace neumann {

struct LeftOut {
    // V(x, y) = 1 for points x and y of surfaces that are not in one plane: all surfaces lie on the boundary of a convex body.
    bool shadow_rays_in_room = false;
    // No side that reflects sees a surface: rays that leave it hit nothing, and it is never in shadow above its horizon.
    bool rays_from_surfaces = false;
    // No ray can hit a light: the ray after the last reflection is needed only for the rest.
    bool rays_for_light = false;
    // BSDF sampling alone finds the light, which is the same everywhere: multiple importance sampling takes no light samples.
    bool light_samples = false;
};

// Whether x and y on the boundary of a convex body certainly see each other: they are not in one plane, by more than
// the rounding errors of the hits.
inline bool see_through_room(const SurfacePoint& x, const SurfacePoint& y) {
    const Vec3 d = y.position - x.position;
    const double rounding = x.error + y.error;
    return std::abs(glm::dot(x.normal, d)) > rounding && std::abs(glm::dot(y.normal, d)) > rounding;
}

// Whether V(x, y) = 1 is known without a ray.
inline bool is_in_sight(const LeftOut& left_out, const SurfacePoint& x, const SurfacePoint& y) {
    return (left_out.rays_from_surfaces && y.is_infinite()) || (left_out.shadow_rays_in_room && see_through_room(x, y));
}

}  // namespace neumann
