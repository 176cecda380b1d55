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

namespace {

FilmPlane plane_ahead(const SensorOptions& options, const Film& film) {
    const double aspect = static_cast<double>(film.width) / film.height;
    const double x = tan_half_width(options.fov, options.fov_axis, aspect), y = x / aspect;
    const Vec2 shift(2.0 * options.principal_point_offset.x * x, 2.0 * options.principal_point_offset.y * y);
    return {rotate(options.to_world, {x + shift.x, y + shift.y, 1.0}), rotate(options.to_world, {-2.0 * x / film.width, 0.0, 0.0}),
            rotate(options.to_world, {0.0, -2.0 * y / film.height, 0.0})};
}

}  // namespace

Perspective::Perspective(const SensorOptions& options, const Film& film)
    : origin_(options.to_world * glm::dvec4(0.0, 0.0, 0.0, 1.0)),
      plane_(plane_ahead(options, film)),
      axis_(glm::normalize(rotate(options.to_world, {0.0, 0.0, 1.0}))),
      near_(options.near_clip),
      far_(options.far_clip) {}

std::optional<FilmPoint> Perspective::see(const Vec3& p, const Vec2&) const {
    return see_through(origin_, plane_, axis_, near_, far_, p);
}

double Perspective::pixels_per_area(const CameraRay& ray, const Vec3& p) const {
    const Vec3 d = p - origin_;
    return plane_.pixels_per_solid_angle(ray.direction) / glm::dot(d, d);
}

std::optional<FilmPoint> see_through(const Vec3& pinhole, const FilmPlane& plane, const Vec3& axis, double near, double far,
                                     const Vec3& p) {
    const Vec3 d = p - pinhole;
    const double depth = glm::dot(d, axis), distance2 = glm::dot(d, d);
    if (!(depth > near && depth < far)) return std::nullopt;
    const Vec3 direction = d / std::sqrt(distance2);
    const Vec3 on_plane = d * (glm::dot(plane.corner(), plane.normal()) / glm::dot(d, plane.normal()));
    return FilmPoint{plane.position(on_plane),
                     {.position = pinhole + d * (near / depth), .normal = -direction},
                     -direction,
                     plane.pixels_per_solid_angle(direction) / distance2};
}

}  // namespace neumann
