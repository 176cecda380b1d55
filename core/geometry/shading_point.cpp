#include "core/geometry/shading_point.h"

#include "core/sampling/warp.h"

#include <cmath>

namespace neumann {

namespace {

bool is_direction(const Vec3& v) {
    const double length = glm::length(v);
    return length > 0.0 && std::isfinite(length);
}

Vec3 weights_at(const TriangleCorners& corners, const Vec3& p) {
    const Vec3 &a = corners.at[0], e1 = corners.at[1] - a, e2 = corners.at[2] - a, d = p - a;
    const Vec3 n = glm::cross(e1, e2);
    const double square = glm::dot(n, n);
    const double v = glm::dot(glm::cross(d, e2), n) / square, w = glm::dot(glm::cross(e1, d), n) / square;
    return {1.0 - v - w, v, w};
}

template <class ValueOf>
auto interpolate(const TriangleCorners& corners, const SurfacePoint& p, const ValueOf& value) {
    const Vec3 weights = weights_at(corners, p.position);
    const auto& t = corners.vertices;
    return value(t[0]) * weights.x + value(t[1]) * weights.y + value(t[2]) * weights.z;
}

Vec3 unit_or(const Vec3& otherwise, const Vec3& v) { return is_direction(v) ? v / glm::length(v) : otherwise; }

Vec3 shading_normal(const TriangleMesh& mesh, const SurfacePoint& p) {
    if (mesh.normals.empty()) return p.normal;
    return unit_or(p.normal, interpolate(corners_of(mesh, p.primitive), p, [&](std::uint32_t i) { return mesh.normals[i]; }));
}
Vec3 shading_normal(const MeshInstance& instance, const SurfacePoint& p) {
    const std::vector<Vec3>& normals = instance.mesh().normals;
    if (normals.empty()) return p.normal;
    return unit_or(p.normal, interpolate(corners_of(instance, p.primitive), p,
                                         [&](std::uint32_t i) { return instance.normal_to_world(normals[i]); }));
}
template <class Round>
Vec3 shading_normal(const Round&, const SurfacePoint& p) {
    return p.normal;
}

// The component of dp_du perpendicular to the normal; zero or not finite if undefined.
Vec3 across(const Vec3& normal, const Vec3& dp_du) { return dp_du - normal * glm::dot(normal, dp_du); }

struct OnTriangle {
    Vec3 e1, e2;                      // edges, from the first vertex
    Vec2 d1{1.0, 0.0}, d2{0.0, 1.0};  // changes of (u, v) along the edges

    OnTriangle(const TriangleCorners& corners, const std::vector<Vec2>& uv)
        : e1(corners.at[1] - corners.at[0]), e2(corners.at[2] - corners.at[0]) {
        if (uv.empty()) return;
        const auto& t = corners.vertices;
        d1 = uv[t[1]] - uv[t[0]];
        d2 = uv[t[2]] - uv[t[0]];
    }
    double determinant() const { return d1.x * d2.y - d1.y * d2.x; }
    Vec3 along_u() const { return (e1 * d2.y - e2 * d1.y) / determinant(); }
    Vec3 along_v() const { return (e2 * d1.x - e1 * d2.x) / determinant(); }
};
Vec2 coordinates(const TriangleCorners& corners, const std::vector<Vec2>& uv, const SurfacePoint& p) {
    if (!uv.empty()) return interpolate(corners, p, [&](std::uint32_t i) { return uv[i]; });
    const Vec3 weights = weights_at(corners, p.position);
    return {weights.y, weights.z};
}

Vec3 along_u(const TriangleMesh& mesh, const SurfacePoint& p) {
    return OnTriangle(corners_of(mesh, p.primitive), mesh.uv).along_u();
}
Vec3 along_v(const TriangleMesh& mesh, const SurfacePoint& p) {
    return OnTriangle(corners_of(mesh, p.primitive), mesh.uv).along_v();
}
Vec2 coordinates(const TriangleMesh& mesh, const SurfacePoint& p) { return coordinates(corners_of(mesh, p.primitive), mesh.uv, p); }

Vec3 along_u(const MeshInstance& instance, const SurfacePoint& p) {
    return OnTriangle(corners_of(instance, p.primitive), instance.mesh().uv).along_u();
}
Vec3 along_v(const MeshInstance& instance, const SurfacePoint& p) {
    return OnTriangle(corners_of(instance, p.primitive), instance.mesh().uv).along_v();
}
Vec2 coordinates(const MeshInstance& instance, const SurfacePoint& p) {
    return coordinates(corners_of(instance, p.primitive), instance.mesh().uv, p);
}

Vec3 on_unit_sphere(const Sphere& sphere, const SurfacePoint& p) {
    return sphere.axes.to_local((p.position - sphere.center) / sphere.radius);
}
Vec3 along_u(const Sphere& sphere, const SurfacePoint& p) {
    const Vec3 n = on_unit_sphere(sphere, p);
    return sphere.axes.to_world({-n.y, n.x, 0.0}) * (2.0 * pi * sphere.radius);
}
Vec3 along_v(const Sphere& sphere, const SurfacePoint& p) {
    const Vec3 n = on_unit_sphere(sphere, p);
    const double from_axis = std::hypot(n.x, n.y);
    return sphere.axes.to_world({n.z * n.x / from_axis, n.z * n.y / from_axis, -from_axis}) * (pi * sphere.radius);
}
Vec2 coordinates(const Sphere& sphere, const SurfacePoint& p) {
    const Vec3 n = on_unit_sphere(sphere, p);
    return {part_of_circle(n.x, n.y), std::atan2(std::hypot(n.x, n.y), n.z) / pi};
}

struct OnDisk {
    Vec2 local;  // in units of its axes
    double r;

    OnDisk(const Disk& disk, const SurfacePoint& p) {
        const Vec3 x = p.position - disk.center, n = glm::cross(disk.u, disk.v);
        const double square = glm::dot(n, n);
        local = {glm::dot(glm::cross(x, disk.v), n) / square, glm::dot(glm::cross(disk.u, x), n) / square};
        r = glm::length(local);
    }
    Vec2 outwards() const { return r > 0.0 ? local / r : Vec2(1.0, 0.0); }
};
Vec3 along_u(const Disk& disk, const SurfacePoint& p) {
    const Vec2 outwards = OnDisk(disk, p).outwards();
    return disk.u * outwards.x + disk.v * outwards.y;
}
// Up to version 3.9.0 Mitsuba omits the factor 2π r, so its bump maps on discs depend on their size.
Vec3 along_v(const Disk& disk, const SurfacePoint& p) {
    const OnDisk at(disk, p);
    const Vec2 outwards = at.outwards();
    return (disk.v * outwards.x - disk.u * outwards.y) * (2.0 * pi * at.r);
}
Vec2 coordinates(const Disk& disk, const SurfacePoint& p) {
    const OnDisk at(disk, p);
    return {at.r, part_of_circle(at.local.x, at.local.y)};
}

Vec3 along_u(const Cylinder& cylinder, const SurfacePoint& p) {
    const Vec3 x = cylinder.axes.to_local(p.position - cylinder.base);
    return cylinder.axes.to_world({-x.y, x.x, 0.0}) * (2.0 * pi);
}
Vec3 along_v(const Cylinder& cylinder, const SurfacePoint&) { return cylinder.axis * cylinder.length; }
Vec2 coordinates(const Cylinder& cylinder, const SurfacePoint& p) {
    const Vec3 x = cylinder.axes.to_local(p.position - cylinder.base);
    return {part_of_circle(x.x, x.y), x.z / cylinder.length};
}

}  // namespace

VertexWeights vertex_weights(const Shape& shape, const SurfacePoint& p) {
    const TriangleCorners corners = corners_of(shape, p.primitive);
    return {corners.vertices, weights_at(corners, p.position)};
}

Vec3 shading_normal(const Shape& shape, const SurfacePoint& p) {
    return std::visit([&](const auto& s) { return shading_normal(s, p); }, shape);
}

ShadingPoint shading_point(const Shape& shape, const SurfacePoint& p) {
    return std::visit(
        [&](const auto& s) -> ShadingPoint {
            const Vec3 normal = shading_normal(s, p), tangent = across(normal, along_u(s, p));
            if (!is_direction(tangent)) return {p, &shape, Frame(normal)};
            const Vec3 x = tangent / glm::length(tangent);
            return {p, &shape, Frame(x, glm::cross(normal, x), normal)};
        },
        shape);
}

ShadingPoint point_with_coordinates(const Vec2& uv) {
    static const Shape triangle = TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    return shading_point(triangle, {{uv, 0.0}, {0.0, 0.0, 1.0}});
}

Vec2 texture_coordinates(const ShadingPoint& p) {
    return std::visit([&](const auto& s) { return coordinates(s, p); }, *p.on);
}

Tangents tangents(const ShadingPoint& p) {
    return std::visit(
        [&](const auto& s) -> Tangents {
            const Vec3 dp_du = along_u(s, p);
            if (!is_direction(across(shading_normal(s, p), dp_du))) return {p.frame.s, p.frame.t};
            return {dp_du, along_v(s, p)};
        },
        *p.on);
}

bool has_smooth_normals(const Shape& shape) {
    const TriangleMesh* mesh = mesh_of(shape);
    return mesh && !mesh->normals.empty();
}

}  // namespace neumann
