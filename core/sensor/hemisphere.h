// What arrives at a point from all directions above it: the film is the disc under the hemisphere, onto which directions are
// projected straight down (Nusselt's analogue). As an area of the disc is cosθ dω,
//
//     E = ∫ L cosθ dω = ∫ L du over the unit disc: 4 times the mean over the film, whose corners are black.
//
// The camera's z is the normal, its x runs to the left and its y up.
#pragma once

#include "core/sensor/sensor_options.h"

namespace neumann {

class Hemisphere {
public:
    Hemisphere(const SensorOptions& options, const Film& film);

    CameraRay ray(const Vec2& position, const Vec2&) const;
    std::optional<FilmPoint> see(const Vec3& p, const Vec2&) const;
    double pixels_per_area(const CameraRay& ray, const Vec3& p) const { return density(ray.direction, p - ray.origin); }
    // 1 in the disc, and 0 in the corners.
    double response(const Vec2& position) const;

private:
    Vec2 on_disc(const Vec2& position) const { return 1.0 - 2.0 * position / size_; }
    // At the end of d, which has this direction.
    double density(const Vec3& direction, const Vec3& d) const {
        return 0.25 * size_.x * size_.y * std::max(glm::dot(direction, normal_), 0.0) / glm::dot(d, d);
    }

    Vec3 origin_, left_, up_, normal_;
    Vec2 size_;  // of the film, pixels
};

}  // namespace neumann
