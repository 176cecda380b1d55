// Parallel rays (Mitsuba's `orthographic`): the film covers −1 … 1 along the camera's x, as much along y as its shape asks for,
// both scaled by to_world.
#pragma once

#include "core/sensor/sensor_options.h"

namespace neumann {

class Orthographic {
public:
    Orthographic(const SensorOptions& options, const Film& film);

    CameraRay ray(const Vec2& position, const Vec2&) const {
        return {corner_ + across_ * position.x + down_ * position.y, direction_, length_};
    }

private:
    Vec3 corner_, across_, down_;  // in the near plane
    Vec3 direction_;
    double length_;
};

}  // namespace neumann
