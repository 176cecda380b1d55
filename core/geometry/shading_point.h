// A surface point with its shading frame (from interpolated normals) and, on demand, texture coordinates. Materials and lights use
// it.
#pragma once

#include "core/base/frame.h"
#include "core/geometry/shape.h"
#include "core/geometry/surface_point.h"

namespace neumann {

struct ShadingPoint : SurfacePoint {
    const Shape* on = nullptr;         // the shape it lies on; null if coordinates are not needed
    Frame frame{Vec3(0.0, 0.0, 1.0)};  // z: the shading normal; x: along dp_du if there are coordinates
};

// The unit normal on the front side: interpolated if a mesh has vertex normals, and otherwise geometric. `p` lies on `shape`.
Vec3 shading_normal(const Shape& shape, const SurfacePoint& p);

// The shading point on the front side. `p` lies on `shape`, which must outlive the result.
ShadingPoint shading_point(const Shape& shape, const SurfacePoint& p);

// A shading point that has texture coordinates only.
ShadingPoint point_with_coordinates(const Vec2& uv);

// Texture coordinates as Mitsuba's: on a sphere, u around its axis and v from pole to pole; on a disc, u from the centre to the rim
// and v around it; on a cylinder, u around it and v along it; on a mesh, those of its vertices, or the weights of the second and
// third vertex. They are computed on demand: few materials need them, and on round shapes they cost as much as a bounce.
Vec2 texture_coordinates(const ShadingPoint& p);

// Partial derivatives of the position by u and v, in scene units; x and y of the frame if they are undefined.
struct Tangents {
    Vec3 dp_du, dp_dv;
};
Tangents tangents(const ShadingPoint& p);

// The vertices of the triangle of a mesh or an instance on which p lies, and their weights there.
struct VertexWeights {
    std::array<std::uint32_t, 3> vertices;
    Vec3 weights;
};
VertexWeights vertex_weights(const Shape& shape, const SurfacePoint& p);

// Whether shading normals of the shape may differ from geometric ones.
bool has_smooth_normals(const Shape& shape);

}  // namespace neumann
