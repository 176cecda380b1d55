// The start of a ray: a point in space or a point on a face. A ray that starts on a flat face does not hit it again, and one that
// starts on a round face does not hit it there, however the point was rounded.
#pragma once

#include "core/geometry/face.h"
#include "core/geometry/surface_point.h"

#include <optional>

namespace neumann {

struct RayStart {
    RayStart(const Vec3& p) : position(p) {}
    RayStart(const SurfacePoint& p) : position(p.position) {
        if (!p.is_infinite()) face = Face{p.shape, p.primitive};
    }

    Vec3 position;
    std::optional<Face> face = {};
};

struct StartedRay {
    const RayStart& start;
    const Vec3& direction;  // unit length
};

}  // namespace neumann
