// A surface point as materials and lights see it: with the frame that interpolated normals give, and with texture coordinates for
// those who ask.
#pragma once

#include "core/base/frame.h"
#include "core/geometry/shape.h"
#include "core/geometry/surface_point.h"

namespace neumann {

struct ShadingPoint : SurfacePoint {
    const Shape* on = nullptr;         // that it lies on; null where nobody asks for coordinates
    Frame frame{Vec3(0.0, 0.0, 1.0)};  // z: the shading normal; x: along dp_du where there are coordinates
};

// On the front side. `p` lies on `shape`, which has to outlive the result.
ShadingPoint shading_point(const Shape& shape, const SurfacePoint& p);

// One of which nothing is known but its texture coordinates.
ShadingPoint point_with_coordinates(const Vec2& uv);

// As Mitsuba's: of a sphere, u around its axis and v from pole to pole; of a disc, u from the centre to the rim and v around it; of
// a cylinder, u around it and v along it; of a mesh, those of its vertices, or the weights of the second and third vertex.
// Computed when asked for: few materials do, and on round shapes it costs as much as a bounce.
Vec2 texture_coordinates(const ShadingPoint& p);

// How the position changes with u and v, in scene units; x and y of the frame where the coordinates do not tell.
struct Tangents {
    Vec3 dp_du, dp_dv;
};
Tangents tangents(const ShadingPoint& p);

// The weights of a triangle's vertices at p.
Vec3 vertex_weights(const TriangleMesh& mesh, const SurfacePoint& p);

// The shading normal differs from the geometric one.
bool has_smooth_normals(const Shape& shape);

}  // namespace neumann
