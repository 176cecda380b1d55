// The pinhole camera (Mitsuba's `perspective`).
#pragma once

#include "core/sensor/sensor_options.h"

namespace neumann {

// How a pinhole sees p through a plane given relative to the pinhole; nothing if p is not between the depths `near` and `far` along
// the axis.
std::optional<FilmPoint> see_through(const Vec3& pinhole, const FilmPlane& plane, const Vec3& axis, double near, double far,
                                     const Vec3& p);

class Perspective {
public:
    Perspective(const SensorOptions& options, const Film& film);

    CameraRay ray(const Vec2& position, const Vec2&) const {
        const Vec3 direction = glm::normalize(plane_.at(position));
        const double along = 1.0 / glm::dot(direction, axis_);  // distance per unit of depth
        return {origin_ + direction * (near_ * along), direction, (far_ - near_) * along};
    }
    // Nothing if p is not between the near and the far plane. The position may be outside the film.
    std::optional<FilmPoint> see(const Vec3& p, const Vec2&) const;
    double pixels_per_area(const CameraRay& ray, const Vec3& p) const;

private:
    Vec3 origin_;
    FilmPlane plane_;  // unnormalised direction towards a film position, with z component 1 in camera space
    Vec3 axis_;
    double near_, far_;
};

}  // namespace neumann
