// Where a ray starts: anywhere in space, or on a face, which a flat one does not meet again and a round one not there, whatever
// rounding has made of the point.
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

}  // namespace neumann
