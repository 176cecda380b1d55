// A scene seen from above, as an architect draws it: without perspective, and what the camera looks at lies up the page.
#pragma once

#include "core/sensor/sensor.h"

namespace neumann {

// The plan is seen along the axis of the world that is nearest to the camera's own up; the page's axes are axes of the world, too.
struct FloorPlan {
    explicit FloorPlan(const SensorOptions& camera);

    // The position on the page, x to the right and y down.
    Vec2 at(const Vec3& p) const { return {glm::dot(p, right), glm::dot(p, down)}; }

    Vec3 right{0.0}, down{0.0}, from_above{0.0};  // unit length; `from_above` is the direction of view
};

}  // namespace neumann
