// Points on spheres, discs and cylinders, in double. `error`: of the shape; points keep clear of rims by it, as hits of triangles
// do of edges, so that rounding cannot push them past what meets the rim.
#pragma once

#include "core/geometry/shape.h"

namespace neumann {

struct RoundPoint {
    Vec3 position, normal;  // scene units; unit length
};

// Where a ray hits of which Embree says, in floats, that it does so at `distance`.
RoundPoint hit_round(const Shape& shape, const Vec3& origin, const Vec3& direction, double distance, double error);
// Of a point beside it.
RoundPoint put_on_round(const Shape& shape, const Vec3& position, double error);
// Uniform by area: the point at (u, v) ∈ [0,1)², and the (u, v) of a point.
RoundPoint sample_round(const Shape& shape, const Vec2& uv, double error);
Vec2 round_coordinates(const Shape& shape, const Vec3& position);
double round_area(const Shape& shape);

}  // namespace neumann
