#include "core/geometry/shading_point.h"

#include "core/sampling/warp.h"

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

// dp_du and dp_dv as they are, or any two tangents where the coordinates do not tell them.
void set_tangents(ShadingPoint& p, const Vec3& normal, const Vec3& dp_du, const Vec3& dp_dv) {
    p.dp_du = dp_du;
    p.dp_dv = dp_dv;
    const Vec3 tangent = dp_du - normal * glm::dot(normal, dp_du);
    const double length = glm::length(tangent);
    if (length > 0.0 && std::isfinite(length)) {
        const Vec3 s = tangent / length;
        p.frame = Frame(s, glm::cross(normal, s), normal);
    } else {
        p.frame = Frame(normal);
        p.dp_du = p.frame.s;
        p.dp_dv = p.frame.t;
    }
}

void shade(const TriangleMesh& mesh, ShadingPoint& p) {
    p.mesh = &mesh;
    const auto& t = mesh.triangles[p.primitive];
    const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const Vec3 weights = vertex_weights(mesh, p);
    const auto interpolate = [&](const auto& values) {
        return values[t[0]] * weights.x + values[t[1]] * weights.y + values[t[2]] * weights.z;
    };
    Vec3 normal = p.normal;
    if (!mesh.normals.empty()) {
        const Vec3 n = interpolate(mesh.normals);
        const double length = glm::length(n);
        if (length > 0.0 && std::isfinite(length)) normal = n / length;
    }
    Vec3 dp_du(0.0), dp_dv(0.0);
    if (!mesh.uv.empty()) {
        p.uv = interpolate(mesh.uv);
        const Vec2 d1 = mesh.uv[t[1]] - mesh.uv[t[0]], d2 = mesh.uv[t[2]] - mesh.uv[t[0]];
        const double determinant = d1.x * d2.y - d1.y * d2.x;
        dp_du = ((b - a) * d2.y - (c - a) * d1.y) / determinant;
        dp_dv = ((c - a) * d1.x - (b - a) * d2.x) / determinant;
    } else {
        p.uv = {weights.y, weights.z};
        dp_du = b - a;
        dp_dv = c - a;
    }
    set_tangents(p, normal, dp_du, dp_dv);
}

void shade(const Sphere& sphere, ShadingPoint& p) {
    const Vec3 n = sphere.axes.to_local((p.position - sphere.center) / sphere.radius);
    const double across = std::hypot(n.x, n.y);
    p.uv = {part_of_circle(n.x, n.y), std::atan2(across, n.z) / pi};
    const Vec3 dp_du = sphere.axes.to_world({-n.y, n.x, 0.0});
    const Vec3 dp_dv = sphere.axes.to_world({n.z * n.x / across, n.z * n.y / across, -across});
    set_tangents(p, p.normal, dp_du * (2.0 * pi * sphere.radius), dp_dv * (pi * sphere.radius));
}

void shade(const Disk& disk, ShadingPoint& p) {
    const Vec3 x = p.position - disk.center, n = glm::cross(disk.u, disk.v);
    const double square = glm::dot(n, n);
    const Vec2 local(glm::dot(glm::cross(x, disk.v), n) / square, glm::dot(glm::cross(disk.u, x), n) / square);
    const double r = glm::length(local);
    p.uv = {r, part_of_circle(local.x, local.y)};
    const Vec2 outwards = r > 0.0 ? local / r : Vec2(1.0, 0.0);
    // Mitsuba leaves 2π r out of the second, which makes its bump maps on discs depend on their size.
    set_tangents(p, p.normal, disk.u * outwards.x + disk.v * outwards.y,
                 (disk.v * outwards.x - disk.u * outwards.y) * (2.0 * pi * r));
}

void shade(const Cylinder& cylinder, ShadingPoint& p) {
    const Vec3 x = cylinder.axes.to_local(p.position - cylinder.base);
    p.uv = {part_of_circle(x.x, x.y), x.z / cylinder.length};
    set_tangents(p, p.normal, cylinder.axes.to_world({-x.y, x.x, 0.0}) * (2.0 * pi), cylinder.axis * cylinder.length);
}

}  // namespace

Vec3 vertex_weights(const TriangleMesh& mesh, const SurfacePoint& p) {
    const auto& t = mesh.triangles[p.primitive];
    const Vec3 &a = mesh.vertices[t[0]], e1 = mesh.vertices[t[1]] - a, e2 = mesh.vertices[t[2]] - a, d = p.position - a;
    const Vec3 n = glm::cross(e1, e2);
    const double square = glm::dot(n, n);
    const double v = glm::dot(glm::cross(d, e2), n) / square, w = glm::dot(glm::cross(e1, d), n) / square;
    return {1.0 - v - w, v, w};
}

ShadingPoint shading_point(const Shape& shape, const SurfacePoint& surface_point) {
    ShadingPoint p{surface_point};
    std::visit([&](const auto& s) { shade(s, p); }, shape);
    return p;
}

bool has_smooth_normals(const Shape& shape) {
    const auto* mesh = std::get_if<TriangleMesh>(&shape);
    return mesh && !mesh->normals.empty();
}

}  // namespace neumann
