#include "core/geometry/triangle_mesh.h"

#include "core/base/error.h"

#include <algorithm>

namespace neumann {

namespace {

double twice_area(const Vec3& a, const Vec3& b, const Vec3& c) { return glm::length(glm::cross(b - a, c - a)); }

}  // namespace

const MeshAttribute* TriangleMesh::attribute(const std::string& name) const {
    const auto found = std::find_if(attributes.begin(), attributes.end(), [&](const MeshAttribute& a) { return a.name == name; });
    return found == attributes.end() ? nullptr : &*found;
}

Bounds TriangleCorners::bounds() const {
    Bounds bounds;
    for (const Vec3& corner : at) bounds.add(corner);
    return bounds;
}

double TriangleCorners::longest_edge() const {
    return std::max({glm::length(at[1] - at[0]), glm::length(at[2] - at[0]), glm::length(at[2] - at[1])});
}

TriangleCorners corners_of(const TriangleMesh& mesh, std::uint32_t triangle) {
    const auto& t = mesh.triangles[triangle];
    return {{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}, t};
}

void expect_valid(const TriangleMesh& mesh) {
    for (const Vec3& v : mesh.vertices)
        if (!is_finite(v)) throw InputError("mesh vertex is not finite");
    for (const auto& t : mesh.triangles)
        for (const std::uint32_t index : t)
            if (index >= mesh.vertices.size())
                throw InputError("mesh vertex index " + std::to_string(index) + " is out of range, the mesh has " +
                                 std::to_string(mesh.vertices.size()) + " vertices");
}

std::size_t erase_degenerate_triangles(TriangleMesh& mesh) {
    const std::size_t count = mesh.triangles.size();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const auto t = mesh.triangles[i];
        if (!(twice_area(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]) > 0.0)) continue;
        mesh.triangles[kept] = t;
        for (MeshAttribute& a : mesh.attributes)
            if (a.of_triangles) a.values[kept] = a.values[i];
        ++kept;
    }
    mesh.triangles.resize(kept);
    for (MeshAttribute& a : mesh.attributes)
        if (a.of_triangles) a.values.resize(kept);
    return count - kept;
}

}  // namespace neumann
