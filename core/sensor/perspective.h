// The pinhole camera (Mitsuba's `perspective`).
#pragma once

#include "core/sensor/sensor_options.h"

namespace neumann {

// What a pinhole sees of p through a plane, whose places are given from the pinhole; between two depths along an axis.
std::optional<FilmPoint> see_through(const Vec3& pinhole, const FilmPlane& plane, const Vec3& axis, double near, double far,
                                     const Vec3& p);

class Perspective {
public:
    Perspective(const SensorOptions& options, const Film& film);

    CameraRay ray(const Vec2& position, const Vec2&) const;
    // Nothing where p is before or beyond the camera's planes. The film may end before the position.
    std::optional<FilmPoint> see(const Vec3& p, const Vec2&) const;
    double pixels_per_area(const CameraRay& ray, const Vec3& p) const;

private:
    Vec3 origin_;
    FilmPlane plane_;  // direction towards a film position before normalising, z component 1 in camera space
    Vec3 axis_;
    double near_, far_;
};

}  // namespace neumann
