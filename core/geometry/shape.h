// The shapes: triangle meshes, and exact (not tessellated) spheres, discs and cylinders. Scene units, double.
#pragma once

#include "core/base/frame.h"
#include "core/geometry/bounds.h"

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace neumann {

// Colours that a file assigns to the vertices or triangles of a mesh ("vertex_color", "face_color"). Float, as in files.
struct MeshAttribute {
    std::string name;
    bool of_triangles = false;
    std::vector<std::array<float, 3>> values = {};
};

// Front side: vertices counter-clockwise.
struct TriangleMesh {
    std::vector<Vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    // One for each vertex, or empty: shading normals, on the front side, and texture coordinates.
    std::vector<Vec3> normals = {};
    std::vector<Vec2> uv = {};
    std::vector<MeshAttribute> attributes = {};

    const MeshAttribute* attribute(const std::string& name) const;
};

// Front side: outside, or inside when flipped.
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

    // The a and b of a point in its plane, or of the point below p.
    Vec2 coordinates(const Vec3& p) const {
        const Vec3 f = p - center;
        const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v), gram = uu * vv - uv * uv;
        return {glm::dot(f, (u * vv - v * uv) / gram), glm::dot(f, (v * uu - u * uv) / gram)};
    }
};

// The lateral surface around base + s·axis, 0 ≤ s ≤ length, open at both ends. Front side: outside, or inside when flipped.
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

using Shape = std::variant<TriangleMesh, Sphere, Disk, Cylinder>;

// For a mesh: whether it has triangles. Triangles without area must have been removed before.
bool has_extent(const Shape& shape);
Bounds bounds_of(const Shape& shape);

// Mitsuba's rectangle [-1,1]² facing +z and cube [-1,1]³ facing outwards, transformed. Texture coordinates [0,1]² on each face.
TriangleMesh make_rectangle(const Mat4& to_world, bool flip_normals = false);
TriangleMesh make_cube(const Mat4& to_world, bool flip_normals = false);
// Mitsuba's unit disk facing +z, transformed.
Disk make_disk(const Mat4& to_world, bool flip_normals = false);

}  // namespace neumann
