#include "core/sensor/perspective.h"

#include <cmath>

namespace neumann {

namespace {

Vec3 rotate(const Mat4& m, const Vec3& v) { return Vec3(m * glm::dvec4(v, 0.0)); }

}  // namespace

double tan_half_width(double fov, FovAxis axis, double aspect) {
    const double t = std::tan(fov / 2.0);
    switch (axis) {
        case FovAxis::x:
            return t;
        case FovAxis::y:
            return t * aspect;
        case FovAxis::diagonal:
            return t * aspect / std::sqrt(1.0 + aspect * aspect);
        case FovAxis::smaller:
            return aspect > 1.0 ? t * aspect : t;
        case FovAxis::larger:
            return aspect > 1.0 ? t : t * aspect;
    }
    return t;
}

Perspective::Perspective(const SensorOptions& options, const Film& film) : near_(options.near_clip), far_(options.far_clip) {
    const double aspect = static_cast<double>(film.width) / film.height;
    const double x = tan_half_width(options.fov, options.fov_axis, aspect), y = x / aspect;
    const Vec2 shift(2.0 * options.principal_point_offset.x * x, 2.0 * options.principal_point_offset.y * y);
    origin_ = Vec3(options.to_world * glm::dvec4(0.0, 0.0, 0.0, 1.0));
    axis_ = glm::normalize(rotate(options.to_world, {0.0, 0.0, 1.0}));
    corner_ = rotate(options.to_world, {x + shift.x, y + shift.y, 1.0});
    across_ = rotate(options.to_world, {-2.0 * x / film.width, 0.0, 0.0});
    down_ = rotate(options.to_world, {0.0, -2.0 * y / film.height, 0.0});
}

CameraRay Perspective::ray(const Vec2& position, const Vec2&) const {
    const Vec3 direction = glm::normalize(corner_ + across_ * position.x + down_ * position.y);
    const double along = 1.0 / glm::dot(direction, axis_);  // distance per unit of depth
    return {origin_ + direction * (near_ * along), direction, (far_ - near_) * along};
}

}  // namespace neumann
