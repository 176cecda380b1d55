// The shapes: triangle meshes, instances of them, and exact (not tessellated) spheres, discs and cylinders. Scene units, double.
#pragma once

#include "core/base/frame.h"
#include "core/geometry/bounds.h"
#include "core/geometry/mesh_instance.h"
#include "core/geometry/triangle_mesh.h"

#include <variant>

namespace neumann {

// The front is outside, or inside when flipped.
struct Sphere {
    Vec3 center{0.0};
    double radius = 1.0;
    bool flip_normals = false;
    // Its axes, for texture coordinates: u runs around n, from s to t, and v from n to −n.
    Frame axes = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
};

// The ellipse center + a·u + b·v, a² + b² ≤ 1, with u ⟂ v not required; `normal` has unit length and is perpendicular to both.
struct Disk {
    Vec3 center{0.0}, u{1.0, 0.0, 0.0}, v{0.0, 1.0, 0.0};
    Vec3 normal{0.0, 0.0, 1.0};

    // The coordinates a and b of a point in the disk's plane, or of the point below p.
    Vec2 coordinates(const Vec3& p) const {
        const Vec3 f = p - center;
        const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v), gram = uu * vv - uv * uv;
        return {glm::dot(f, (u * vv - v * uv) / gram), glm::dot(f, (v * uu - u * uv) / gram)};
    }
};

// The lateral surface around base + s·axis, 0 ≤ s ≤ length, open at both ends. The front is outside, or inside when flipped.
struct Cylinder {
    Vec3 base{0.0}, axis{0.0, 0.0, 1.0};  // axis: unit length
    double length = 1.0, radius = 1.0;
    bool flip_normals = false;
    Frame axes = Frame(axis);  // for texture coordinates: u runs around the axis, from s to t

    bool has_extent() const { return radius > 0.0 && length > 0.0; }
    // Half the size of the bounding box.
    Vec3 extent() const { return glm::abs(axis) * (0.5 * length) + radius * glm::sqrt(glm::max(1.0 - axis * axis, 0.0)); }
    Vec3 center() const { return base + axis * (0.5 * length); }
};

using Shape = std::variant<TriangleMesh, Sphere, Disk, Cylinder, MeshInstance>;

// The mesh of a mesh or of an instance; otherwise null.
const TriangleMesh* mesh_of(const Shape& shape);
// The corners of a triangle of a mesh or an instance.
TriangleCorners corners_of(const Shape& shape, std::uint32_t triangle);

// Whether a shape has extent; for a mesh, whether it has triangles. Triangles without area must have been removed before.
bool has_extent(const Shape& shape);
// The bounding box; that of an instance may be larger than necessary.
Bounds bounds_of(const Shape& shape);

// Mitsuba's rectangle [-1,1]² facing +z and cube [-1,1]³ facing outwards, transformed. Texture coordinates [0,1]² on each face.
TriangleMesh make_rectangle(const Mat4& to_world, bool flip_normals = false);
TriangleMesh make_cube(const Mat4& to_world, bool flip_normals = false);
// Mitsuba's unit disk facing +z, transformed.
Disk make_disk(const Mat4& to_world, bool flip_normals = false);

}  // namespace neumann
