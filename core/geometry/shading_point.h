// A surface point as materials and lights see it: with its texture coordinates, and with the frame that interpolated normals give.
#pragma once

#include "core/base/frame.h"
#include "core/geometry/shape.h"
#include "core/geometry/surface_point.h"

namespace neumann {

struct ShadingPoint : SurfacePoint {
    Vec2 uv{0.0};
    Vec3 dp_du{0.0}, dp_dv{0.0};         // change of the position with u and v
    Frame frame{Vec3(0.0, 0.0, 1.0)};    // z: the shading normal; x: along dp_du where there are coordinates
    const TriangleMesh* mesh = nullptr;  // that it lies on, where it lies on one
};

// On the front side. `p` lies on `shape`. Coordinates as Mitsuba's: of a sphere, u around its axis and v from pole to pole; of a
// disc, u from the centre to the rim and v around it; of a cylinder, u around it and v along it; of a mesh, those of its vertices,
// or the weights of the second and third vertex.
ShadingPoint shading_point(const Shape& shape, const SurfacePoint& p);

// The weights of a triangle's vertices at p.
Vec3 vertex_weights(const TriangleMesh& mesh, const SurfacePoint& p);

// The shading normal differs from the geometric one.
bool has_smooth_normals(const Shape& shape);

}  // namespace neumann
