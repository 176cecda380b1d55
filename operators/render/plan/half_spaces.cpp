#include "operators/render/plan/half_spaces.h"

#include "core/sampling/spherical_triangle.h"
#include "core/sampling/warp.h"

#include <algorithm>

namespace neumann {

namespace {

// Limit on the number of planes times vertices, which takes a fraction of a second.
constexpr double most_work = 1e8;

// max over the shape of n·(x − origin); for an instance an upper bound.
double support(const TriangleMesh& mesh, const Vec3& n, const Vec3& origin) {
    double most = -std::numeric_limits<double>::infinity();
    for (const Vec3& v : mesh.vertices) most = std::max(most, glm::dot(n, v - origin));
    return most;
}
double support(const MeshInstance& instance, const Vec3& n, const Vec3& origin) {
    const Bounds b = instance.bounds();
    return glm::dot(n, b.center() - origin) + 0.5 * glm::dot(glm::abs(n), b.high - b.low);
}
double support(const Sphere& s, const Vec3& n, const Vec3& origin) { return glm::dot(n, s.center - origin) + s.radius; }
double support(const Disk& d, const Vec3& n, const Vec3& origin) {
    return glm::dot(n, d.center - origin) + std::hypot(glm::dot(n, d.u), glm::dot(n, d.v));
}
double support(const Cylinder& c, const Vec3& n, const Vec3& origin) {
    const double along = glm::dot(n, c.axis);
    return glm::dot(n, c.base - origin) + std::max(along * c.length, 0.0) +
           c.radius * std::sqrt(std::max(1.0 - along * along, 0.0));
}

// The longer semi-axis of the ellipse a·u + b·v, a² + b² = 1.
double longest(const Vec3& u, const Vec3& v) {
    const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
    return std::sqrt(0.5 * (uu + vv + std::hypot(uu - vv, 2.0 * uv)));
}
Vec3 across(const Vec3& d, const Vec3& axis) { return d - axis * glm::dot(axis, d); }

}  // namespace

HalfSpaces::HalfSpaces(const Geometry& geometry)
    : geometry_(geometry), shapes_(geometry.shapes()), rounding_(geometry.radius() * 0x1p-32) {
    double vertices = 0.0, planes = 0.0;
    for (const Shape& shape : shapes_) {
        const TriangleMesh* mesh = mesh_of(shape);
        vertices += mesh ? static_cast<double>(mesh->vertices.size()) : 1.0;
        planes += mesh ? static_cast<double>(mesh->triangles.size()) : 1.0;
    }
    are_too_many_ = planes * vertices > most_work;
}

bool HalfSpaces::end_at(const Vec3& p, const Vec3& n) const {
    return std::all_of(shapes_.begin(), shapes_.end(), [&](const Shape& shape) {
        return std::visit([&](const auto& s) { return support(s, n, p); }, shape) <= rounding_;
    });
}

bool HalfSpaces::are_within(const Sphere& ball) const {
    return all_others(
        ball, [&](const Vec3& p) { return glm::length(p - ball.center); }, longest);
}
bool HalfSpaces::are_within(const Cylinder& c) const {
    return all_others(
        c, [&](const Vec3& p) { return glm::length(across(p - c.base, c.axis)); },
        [&](const Vec3& u, const Vec3& v) { return longest(across(u, c.axis), across(v, c.axis)); });
}
// Whether all other shapes are within a ball or cylinder. `distance`: of a point from its centre or axis; `reach`: the
// distance by which a disc extends at most beyond its centre.
template <class Round, class Distance, class Reach>
bool HalfSpaces::all_others(const Round& round, const Distance& distance, const Reach& reach) const {
    const double most = round.radius + rounding_;
    return std::all_of(shapes_.begin(), shapes_.end(), [&](const Shape& shape) {
        if (const auto* mesh = std::get_if<TriangleMesh>(&shape))
            return std::all_of(mesh->vertices.begin(), mesh->vertices.end(), [&](const Vec3& v) { return distance(v) <= most; });
        if (const auto* sphere = std::get_if<Sphere>(&shape)) return distance(sphere->center) + sphere->radius <= most;
        if (const auto* disk = std::get_if<Disk>(&shape)) return distance(disk->center) + reach(disk->u, disk->v) <= most;
        if (std::holds_alternative<MeshInstance>(shape)) return false;
        return std::get_if<Round>(&shape) == &round;
    });
}

template <class F>
bool HalfSpaces::all_planes(std::uint32_t shape, const F& f) const {
    for (std::uint32_t primitive = 0; primitive < geometry_.primitive_count(shape); ++primitive) {
        const SurfacePoint p = geometry_.point(shape, primitive, Vec2(0.5));
        if (!f(p.position, p.normal)) return false;
    }
    return true;
}

// The sum of the solid angles of all surfaces, sr, seen from a point inside the convex body (4π if it is closed); 0 if there are
// shapes other than meshes.
double HalfSpaces::solid_angle_from_inside() const {
    Vec3 middle(0.0);
    double vertices = 0.0, sum = 0.0;
    for (const Shape& shape : shapes_) {
        const auto* mesh = std::get_if<TriangleMesh>(&shape);
        if (!mesh) return 0.0;
        for (const Vec3& v : mesh->vertices) middle += v - geometry_.center();
        vertices += static_cast<double>(mesh->vertices.size());
    }
    middle = geometry_.center() + middle / vertices;
    for (const Shape& shape : shapes_) {
        const auto& mesh = std::get<TriangleMesh>(shape);
        for (const auto& t : mesh.triangles)
            sum += solid_angle(mesh.vertices[t[0]] - middle, mesh.vertices[t[1]] - middle, mesh.vertices[t[2]] - middle);
    }
    return sum;
}

ConvexBody HalfSpaces::convex_body() const {
    if (shapes_.empty() || are_too_many_) return {};
    if (const auto* sphere = std::get_if<Sphere>(&shapes_.front()); sphere && shapes_.size() == 1)
        return {sphere->radius > 0.0, sphere->flip_normals, true};
    ConvexBody body{true, true, false};
    for (std::uint32_t shape = 0; shape < shapes_.size() && body.found; ++shape) {
        if (std::holds_alternative<Sphere>(shapes_[shape]))
            body.found = false;
        else if (const auto* cylinder = std::get_if<Cylinder>(&shapes_[shape])) {
            body.found = are_within(*cylinder);
            body.fronts_face_inwards = body.fronts_face_inwards && cylinder->flip_normals;
        } else
            body.found = all_planes(shape, [&](const Vec3& p, const Vec3& n) {
                if (end_at(p, -n)) return true;
                body.fronts_face_inwards = false;
                return end_at(p, n);
            });
    }
    if (!body.found) return {};
    body.is_closed = solid_angle_from_inside() >= 4.0 * pi * (1.0 - 1e-10);
    return body;
}

bool HalfSpaces::no_surface_seen_from(std::uint32_t shape, bool front) const {
    if (are_too_many_) return false;
    const Shape& what = shapes_[shape];
    if (const auto* sphere = std::get_if<Sphere>(&what)) return front != sphere->flip_normals && are_within(*sphere);
    if (const auto* cylinder = std::get_if<Cylinder>(&what)) return front != cylinder->flip_normals && are_within(*cylinder);
    return all_planes(shape, [&](const Vec3& p, const Vec3& n) { return end_at(p, front ? n : -n); });
}

}  // namespace neumann
