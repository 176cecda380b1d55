#include "core/geometry/shape.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace neumann {

namespace {

Vec3 transform_point(const Mat4& m, const Vec3& p) { return Vec3(m * glm::dvec4(p, 1.0)); }
Vec3 transform_vector(const Mat4& m, const Vec3& v) { return Vec3(m * glm::dvec4(v, 0.0)); }

// A mirroring transform reverses the winding, but Mitsuba's own shapes still face the same side.
void orient(TriangleMesh& mesh, const Mat4& to_world, bool flip_normals) {
    if ((glm::determinant(glm::dmat3(to_world)) < 0.0) == flip_normals) return;
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

}  // namespace

const MeshAttribute* TriangleMesh::attribute(const std::string& name) const {
    const auto found = std::find_if(attributes.begin(), attributes.end(), [&](const MeshAttribute& a) { return a.name == name; });
    return found == attributes.end() ? nullptr : &*found;
}

bool has_extent(const Shape& shape) {
    if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) return !mesh->triangles.empty();
    if (const auto* sphere = std::get_if<Sphere>(&shape)) return sphere->radius > 0.0;
    if (const auto* disk = std::get_if<Disk>(&shape)) return glm::length(glm::cross(disk->u, disk->v)) > 0.0;
    return std::get<Cylinder>(shape).has_extent();
}

Bounds bounds_of(const Shape& shape) {
    Bounds bounds;
    if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) {
        for (const auto& t : mesh->triangles)
            for (const std::uint32_t index : t) bounds.add(mesh->vertices[index]);
        return bounds;
    }
    Vec3 center, extent;
    if (const auto* sphere = std::get_if<Sphere>(&shape)) {
        center = sphere->center;
        extent = Vec3(sphere->radius);
    } else if (const auto* disk = std::get_if<Disk>(&shape)) {
        center = disk->center;
        extent = {std::hypot(disk->u.x, disk->v.x), std::hypot(disk->u.y, disk->v.y), std::hypot(disk->u.z, disk->v.z)};
    } else {
        center = std::get<Cylinder>(shape).center();
        extent = std::get<Cylinder>(shape).extent();
    }
    bounds.add(center - extent);
    bounds.add(center + extent);
    return bounds;
}

TriangleMesh make_rectangle(const Mat4& to_world, bool flip_normals) {
    TriangleMesh mesh;
    for (const Vec3 corner : {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)})
        mesh.vertices.push_back(transform_point(to_world, corner));
    mesh.uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    orient(mesh, to_world, flip_normals);
    return mesh;
}

TriangleMesh make_cube(const Mat4& to_world, bool flip_normals) {
    // The corner with (u, v) = (0, 0), and the edges along u and v; v × u points outwards.
    struct Face {
        Vec3 corner, u, v;
    };
    static const Face faces[] = {{{-1, 1, -1}, {0, -2, 0}, {2, 0, 0}}, {{-1, -1, 1}, {0, 2, 0}, {2, 0, 0}},
                                 {{-1, -1, -1}, {0, 0, 2}, {2, 0, 0}}, {{1, 1, 1}, {-2, 0, 0}, {0, 0, -2}},
                                 {{-1, -1, -1}, {0, 2, 0}, {0, 0, 2}}, {{1, -1, 1}, {0, 2, 0}, {0, 0, -2}}};
    TriangleMesh mesh;
    for (const Face& f : faces) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (const Vec2 uv : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}) {
            mesh.vertices.push_back(transform_point(to_world, f.corner + f.u * uv.x + f.v * uv.y));
            mesh.uv.push_back(uv);
        }
        mesh.triangles.push_back({first, first + 2, first + 1});
        mesh.triangles.push_back({first, first + 3, first + 2});
    }
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
