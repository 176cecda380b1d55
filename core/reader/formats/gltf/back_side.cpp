#include "core/reader/formats/gltf/back_side.h"

#include "core/geometry/bounds.h"

#include <utility>

namespace neumann::reader::gltf {

namespace {

// At each vertex the sum of the normals of its triangles, each as long as twice the triangle's area.
std::vector<Vec3> normals_of(const TriangleMesh& mesh) {
    std::vector<Vec3> normals(mesh.vertices.size(), Vec3(0.0));
    for (const auto& t : mesh.triangles) {
        const Vec3 n = glm::cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]);
        for (const std::uint32_t v : t) normals[v] += n;
    }
    return normals;
}

}  // namespace

MeshFile back_side(const MeshFile& front) {
    MeshFile back = front;
    Bounds bounds;
    for (const Vec3& v : front.mesh.vertices) bounds.add(v);
    const double distance = 2e-4 * bounds.radius();
    const std::vector<Vec3> normals = normals_of(front.mesh);
    for (std::size_t i = 0; i < normals.size(); ++i)
        if (const double length = length_of(normals[i]); length > 0.0) back.mesh.vertices[i] -= normals[i] * (distance / length);
    for (auto& t : back.mesh.triangles) std::swap(t[1], t[2]);
    for (Vec3& n : back.normals) n = -n;
    return back;
}

}  // namespace neumann::reader::gltf
