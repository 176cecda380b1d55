// The pinhole camera (Mitsuba's `perspective`).
#pragma once

#include "core/sensor/sensor_options.h"

namespace neumann {

class Perspective {
public:
    Perspective(const SensorOptions& options, const Film& film);

    CameraRay ray(const Vec2& position, const Vec2&) const;

private:
    Vec3 origin_, corner_, across_, down_;  // direction towards a film position before normalising, z component 1 in camera space
    Vec3 axis_;
    double near_, far_;
};

}  // namespace neumann
