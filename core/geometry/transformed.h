// Shapes moved by an affine map that has an inverse. Their sides stay their sides, also where the map mirrors.
#pragma once

#include "core/geometry/shape.h"

#include <optional>

namespace neumann {

TriangleMesh transformed(const TriangleMesh& mesh, const Mat4& to_world);
Disk transformed(const Disk& disk, const Mat4& to_world);
// Empty where it would be an ellipsoid: the scale has to be the same in all directions, to 10⁻⁴.
std::optional<Sphere> transformed(const Sphere& sphere, const Mat4& to_world);
// Empty where it would be elliptic or oblique: the scale has to be the same all around the axis, to 10⁻⁴.
std::optional<Cylinder> transformed(const Cylinder& cylinder, const Mat4& to_world);
std::optional<Shape> transformed(const Shape& shape, const Mat4& to_world);

}  // namespace neumann
