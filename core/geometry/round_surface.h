// Points on spheres, discs and cylinders, in double. `error` is the rounding error of the shape. Points keep this distance from
// rims, as hits on triangles do from edges, so that rounding cannot move them past a surface that touches the rim.
#pragma once

#include "core/geometry/shape.h"

namespace neumann {

struct RoundPoint {
    Vec3 position, normal;  // scene units; unit length
};

// The exact hit of a ray for which Embree found a hit at `distance`, in floats.
RoundPoint hit_round(const Shape& shape, const Vec3& origin, const Vec3& direction, double distance, double error);
// The point on the shape next to a given position.
RoundPoint put_on_round(const Shape& shape, const Vec3& position, double error);
// Uniform sampling by area: the point at (u, v) ∈ [0,1)², and its inverse, the (u, v) of a point.
RoundPoint sample_round(const Shape& shape, const Vec2& uv, double error);
Vec2 round_coordinates(const Shape& shape, const Vec3& position);
double round_area(const Shape& shape);

}  // namespace neumann
