#include "core/geometry/shape.h"

#include "core/geometry/affine.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace neumann {

namespace {

// A mirroring transform reverses the winding, but Mitsuba's own shapes still face the same side.
void orient(TriangleMesh& mesh, const Mat4& to_world, bool flip_normals) {
    if ((glm::determinant(glm::dmat3(to_world)) < 0.0) == flip_normals) return;
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

}  // namespace

const TriangleMesh* mesh_of(const Shape& shape) {
    if (const auto* instance = std::get_if<MeshInstance>(&shape)) return &instance->mesh();
    return std::get_if<TriangleMesh>(&shape);
}

TriangleCorners corners_of(const Shape& shape, std::uint32_t triangle) {
    if (const auto* instance = std::get_if<MeshInstance>(&shape)) return corners_of(*instance, triangle);
    return corners_of(std::get<TriangleMesh>(shape), triangle);
}

bool has_extent(const Shape& shape) {
    if (const auto* mesh = mesh_of(shape)) return !mesh->triangles.empty();
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
    if (const auto* instance = std::get_if<MeshInstance>(&shape)) return instance->bounds();
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
        mesh.vertices.push_back(transformed_point(to_world, corner));
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
            mesh.vertices.push_back(transformed_point(to_world, f.corner + f.u * uv.x + f.v * uv.y));
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
    disk.center = transformed_point(to_world, Vec3(0.0));
    disk.u = transformed_vector(to_world, {1, 0, 0});
    disk.v = transformed_vector(to_world, {0, 1, 0});
    const Vec3 across = glm::cross(disk.u, disk.v);
    const double side = (glm::determinant(glm::dmat3(to_world)) < 0.0) == flip_normals ? 1.0 : -1.0;
    disk.normal = glm::length(across) > 0.0 ? side * glm::normalize(across) : Vec3(0, 0, 1);
    return disk;
}

}  // namespace neumann
