// A surface point as materials and lights see it: with its texture coordinates, and with the frame that interpolated normals give.
#pragma once

#include "core/base/frame.h"
#include "core/geometry/shape.h"
#include "core/geometry/surface_point.h"

namespace neumann {

struct ShadingPoint : SurfacePoint {
    Vec2 uv{0.0};
    Vec3 dp_du{0.0}, dp_dv{0.0};       // change of the position with u and v
    Frame frame{Vec3(0.0, 0.0, 1.0)};  // z: the shading normal; x: along dp_du where there are coordinates
};

// On the front side. `p` lies on `shape`.
ShadingPoint shading_point(const Shape& shape, const SurfacePoint& p);

// The shading normal differs from the geometric one.
bool has_smooth_normals(const Shape& shape);

}  // namespace neumann
