// Parallel rays (Mitsuba's `orthographic`): the film covers −1 … 1 along the camera's x, and along y according to its aspect ratio;
// to_world scales both.
#pragma once

#include "core/sensor/sensor_options.h"

namespace neumann {

class Orthographic {
public:
    Orthographic(const SensorOptions& options, const Film& film);

    CameraRay ray(const Vec2& position, const Vec2&) const { return {plane_.at(position), direction_, length_}; }
    std::optional<FilmPoint> see(const Vec3& p, const Vec2&) const;
    double pixels_per_area(const CameraRay&, const Vec3&) const {
        return 1.0 / (plane_.area() * std::abs(glm::dot(direction_, plane_.normal())));
    }

private:
    FilmPlane plane_;  // the near plane
    Vec3 direction_;
    double length_;
};

}  // namespace neumann
