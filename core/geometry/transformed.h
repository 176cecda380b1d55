// Applies an invertible affine map to shapes. Front stays front, also if the map mirrors.
#pragma once

#include "core/geometry/shape.h"

#include <optional>

namespace neumann {

TriangleMesh transformed(const TriangleMesh& mesh, const Mat4& to_world);
MeshInstance transformed(const MeshInstance& instance, const Mat4& to_world);
Disk transformed(const Disk& disk, const Mat4& to_world);
// Returns nothing if the result would be an ellipsoid: the scale must be the same in all directions, to 10⁻⁴.
std::optional<Sphere> transformed(const Sphere& sphere, const Mat4& to_world);
// Returns nothing if the result would be elliptic or oblique: the scale must be the same all around the axis, to 10⁻⁴.
std::optional<Cylinder> transformed(const Cylinder& cylinder, const Mat4& to_world);
std::optional<Shape> transformed(const Shape& shape, const Mat4& to_world);

}  // namespace neumann
