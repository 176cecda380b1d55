#include "core/geometry/shape.h"

#include <utility>

namespace neumann {

namespace {

Vec3 transform_point(const Mat4& m, const Vec3& p) { return Vec3(m * glm::dvec4(p, 1.0)); }
Vec3 transform_vector(const Mat4& m, const Vec3& v) { return Vec3(m * glm::dvec4(v, 0.0)); }

// A mirroring transform turns the winding round, but not the side that Mitsuba's own shapes face.
void orient(TriangleMesh& mesh, const Mat4& to_world, bool flip_normals) {
    if ((glm::determinant(glm::dmat3(to_world)) < 0.0) == flip_normals) return;
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

}  // namespace

TriangleMesh make_rectangle(const Mat4& to_world, bool flip_normals) {
    TriangleMesh mesh;
    for (const Vec3 corner : {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)})
        mesh.vertices.push_back(transform_point(to_world, corner));
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    orient(mesh, to_world, flip_normals);
    return mesh;
}

TriangleMesh make_cube(const Mat4& to_world, bool flip_normals) {
    TriangleMesh mesh;
    for (int corner = 0; corner < 8; ++corner)
        mesh.vertices.push_back(transform_point(to_world, {corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1}));
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    orient(mesh, to_world, flip_normals);
    return mesh;
}

Disk make_disk(const Mat4& to_world, bool flip_normals) {
    Disk disk;
    disk.center = transform_point(to_world, Vec3(0.0));
    disk.u = transform_vector(to_world, {1, 0, 0});
    disk.v = transform_vector(to_world, {0, 1, 0});
    const Vec3 across = glm::cross(disk.u, disk.v);
    const double side = (glm::determinant(glm::dmat3(to_world)) < 0.0) == flip_normals ? 1.0 : -1.0;
    disk.normal = glm::length(across) > 0.0 ? side * glm::normalize(across) : Vec3(0, 0, 1);
    return disk;
}

}  // namespace neumann
