// A triangle mesh. Scene units, double; colours as in files, float.
#pragma once

#include "core/base/vec.h"
#include "core/geometry/bounds.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace neumann {

// Colours that a file assigns to the vertices or triangles of a mesh ("vertex_color", "face_color"), in float as in files.
struct MeshAttribute {
    std::string name;
    bool of_triangles = false;
    std::vector<std::array<float, 3>> values = {};
};

// The front is the side from which the vertices are counter-clockwise.
struct TriangleMesh {
    std::vector<Vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    // One for each vertex, or empty: shading normals, on the front side, and texture coordinates.
    std::vector<Vec3> normals = {};
    std::vector<Vec2> uv = {};
    std::vector<MeshAttribute> attributes = {};

    const MeshAttribute* attribute(const std::string& name) const;
};

// The corners of a triangle, counter-clockwise seen from its front, and the numbers of their vertices.
struct TriangleCorners {
    std::array<Vec3, 3> at;
    std::array<std::uint32_t, 3> vertices;

    Bounds bounds() const;
    double longest_edge() const;
};
TriangleCorners corners_of(const TriangleMesh& mesh, std::uint32_t triangle);

// Throws InputError if a coordinate is not finite or an index is out of range.
void expect_valid(const TriangleMesh& mesh);
// Returns how many triangles were erased.
std::size_t erase_degenerate_triangles(TriangleMesh& mesh);

}  // namespace neumann
