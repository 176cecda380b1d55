#include "core/geometry/shading_point.h"

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

// The weights of a triangle's vertices for a point in its plane.
Vec3 barycentric(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
    const Vec3 e1 = b - a, e2 = c - a, d = p - a;
    const Vec3 n = glm::cross(e1, e2);
    const double square = glm::dot(n, n);
    const double v = glm::dot(glm::cross(d, e2), n) / square, w = glm::dot(glm::cross(e1, d), n) / square;
    return {1.0 - v - w, v, w};
}

void shade(const TriangleMesh& mesh, ShadingPoint& p) {
    const auto& t = mesh.triangles[p.primitive];
    const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const Vec3 weights = barycentric(a, b, c, p.position);
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

}  // namespace

ShadingPoint shading_point(const Shape& shape, const SurfacePoint& surface_point) {
    ShadingPoint p{surface_point};
    if (const auto* mesh = std::get_if<TriangleMesh>(&shape))
        shade(*mesh, p);
    else
        set_tangents(p, p.normal, Vec3(0.0), Vec3(0.0));
    return p;
}

bool has_smooth_normals(const Shape& shape) {
    const auto* mesh = std::get_if<TriangleMesh>(&shape);
    return mesh && !mesh->normals.empty();
}

}  // namespace neumann
