#include "core/scene/floor_plan.h"

#include <cmath>

namespace neumann {

namespace {

// The axis of the world, of either sign, that is nearest to v; never number `except`.
Vec3 nearest_axis(const Vec3& v, int except = -1) {
    int nearest = except == 0 ? 1 : 0;
    for (int c = 0; c < 3; ++c)
        if (c != except && std::abs(v[c]) > std::abs(v[nearest])) nearest = c;
    Vec3 axis(0.0);
    axis[nearest] = std::copysign(1.0, v[nearest]);
    return axis;
}

int number_of(const Vec3& axis) { return axis.x != 0.0 ? 0 : axis.y != 0.0 ? 1 : 2; }

}  // namespace

FloorPlan::FloorPlan(const SensorOptions& camera) {
    const Mat4& to_world = camera.sensors.empty() ? camera.to_world : camera.sensors.front().to_world;
    const Vec3 up = nearest_axis(Vec3(to_world[1])), ahead = nearest_axis(Vec3(to_world[2]), number_of(up));
    from_above = -up;
    down = -ahead;
    right = glm::cross(ahead, up);
}

}  // namespace neumann
