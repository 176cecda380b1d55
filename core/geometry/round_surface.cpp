#include "core/geometry/round_surface.h"

#include "core/base/frame.h"
#include "core/sampling/warp.h"

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

// Calls f with the sphere, disc or cylinder.
template <class F>
auto visit_round(const Shape& shape, const F& f) {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) return f(*sphere);
    if (const auto* cylinder = std::get_if<Cylinder>(&shape)) return f(*cylinder);
    return f(std::get<Disk>(shape));
}

// Returns n, or a unit vector next to it, such that the sign of dot(w, n) is `sign`: −1 for a hit from the front, 1 from the back.
// A ray that hits tangentially in floats may miss in double; n is then perpendicular to it up to rounding.
Vec3 met_by(const Vec3& w, double sign, const Vec3& n) {
    constexpr double least = 1e-9;
    const double cosine = sign * glm::dot(n, w);
    return cosine >= least ? n : glm::normalize(n + w * (sign * (least - cosine)));
}

RoundPoint put(const Sphere& s, const Vec3& position, double) {
    const Vec3 n = glm::normalize(position - s.center);
    return {s.center + n * s.radius, s.flip_normals ? -n : n};
}

// `distance` is Embree's result in float; the root next to it is computed in double.
RoundPoint hit(const Sphere& s, const Vec3& origin, const Vec3& direction, double distance, double error) {
    const Vec3 f = origin - s.center;
    const double middle = -glm::dot(f, direction);
    const Vec3 nearest = f + direction * middle;
    const double half = std::sqrt(std::max(s.radius * s.radius - glm::dot(nearest, nearest), 0.0));
    const double side = distance < middle ? -1.0 : 1.0;
    const Vec3 n = glm::normalize(f + direction * (middle + side * half));
    return put(s, s.center + met_by(direction, side, n), error);
}

RoundPoint sample(const Sphere& s, const Vec2& uv, double error) { return put(s, s.center + uniform_sphere(uv), error); }

Vec2 coordinates(const Sphere& s, const Vec3& position) {
    const Vec3 n = (position - s.center) / s.radius;
    return {std::clamp(0.5 - 0.5 * n.z, 0.0, 1.0), part_of_circle(n.x, n.y)};
}

double area(const Sphere& s) { return s.radius > 0.0 ? 4.0 * pi * s.radius * s.radius : 0.0; }

RoundPoint put(const Disk& d, const Vec3& position, double error) {
    const Vec2 at = d.coordinates(position);
    const double radius = std::sqrt(at.x * at.x + at.y * at.y);  // 1 at the rim
    const double uu = glm::dot(d.u, d.u), uv = glm::dot(d.u, d.v), vv = glm::dot(d.v, d.v), gram = uu * vv - uv * uv;
    const double most = 1.0 - std::min(error * std::sqrt(std::max(uu, vv) / gram), 0.5);
    return {radius > most ? d.center + (position - d.center) * (most / radius) : position, d.normal};
}

RoundPoint hit(const Disk& d, const Vec3& origin, const Vec3& direction, double, double error) {
    return put(d, origin + direction * (glm::dot(d.normal, d.center - origin) / glm::dot(d.normal, direction)), error);
}

RoundPoint sample(const Disk& d, const Vec2& uv, double error) {
    const Vec2 place = uniform_disk(uv);
    return put(d, d.center + d.u * place.x + d.v * place.y, error);
}

Vec2 coordinates(const Disk& d, const Vec3& position) {
    const Vec3 x = position - d.center;
    const double uu = glm::dot(d.u, d.u), uv = glm::dot(d.u, d.v), vv = glm::dot(d.v, d.v);
    const double xu = glm::dot(x, d.u), xv = glm::dot(x, d.v), determinant = uu * vv - uv * uv;
    return square_of_disk({(xu * vv - xv * uv) / determinant, (xv * uu - xu * uv) / determinant});
}

double area(const Disk& d) { return pi * glm::length(glm::cross(d.u, d.v)); }

// `across` has any length and is perpendicular to the axis.
RoundPoint put(const Cylinder& c, double along, const Vec3& across, double error) {
    const Vec3 n = glm::normalize(across);
    const double margin = std::min(error, 0.5 * c.length);
    return {c.base + c.axis * std::clamp(along, margin, c.length - margin) + n * c.radius, c.flip_normals ? -n : n};
}

RoundPoint put(const Cylinder& c, const Vec3& position, double error) {
    const double along = glm::dot(position - c.base, c.axis);
    return put(c, along, position - c.base - c.axis * along, error);
}

// Works as for a sphere, perpendicular to the axis.
RoundPoint hit(const Cylinder& c, const Vec3& origin, const Vec3& direction, double distance, double error) {
    const Vec3 f = origin - c.base;
    const double d_along = glm::dot(direction, c.axis), f_along = glm::dot(f, c.axis);
    const Vec3 d_across = direction - c.axis * d_along, f_across = f - c.axis * f_along;
    const double a = glm::dot(d_across, d_across), middle = -glm::dot(f_across, d_across) / a;
    const Vec3 nearest = f_across + d_across * middle;
    const double half = std::sqrt(std::max(c.radius * c.radius - glm::dot(nearest, nearest), 0.0) / a);
    const double side = distance < middle ? -1.0 : 1.0, t = middle + side * half;
    const Vec3 n = met_by(d_across / std::sqrt(a), side, glm::normalize(f_across + d_across * t));
    return put(c, f_along + d_along * t, n, error);
}

RoundPoint sample(const Cylinder& c, const Vec2& uv, double error) {
    return put(c, uv.x * c.length, Frame(c.axis).to_world({direction_on_circle(uv.y), 0.0}), error);
}

Vec2 coordinates(const Cylinder& c, const Vec3& position) {
    const Vec3 p = Frame(c.axis).to_local(position - c.base);
    return {std::clamp(p.z / c.length, 0.0, 1.0), part_of_circle(p.x, p.y)};
}

double area(const Cylinder& c) { return c.has_extent() ? 2.0 * pi * c.radius * c.length : 0.0; }

}  // namespace

RoundPoint hit_round(const Shape& shape, const Vec3& origin, const Vec3& direction, double distance, double error) {
    return visit_round(shape, [&](const auto& s) { return hit(s, origin, direction, distance, error); });
}

RoundPoint put_on_round(const Shape& shape, const Vec3& position, double error) {
    return visit_round(shape, [&](const auto& s) { return put(s, position, error); });
}

RoundPoint sample_round(const Shape& shape, const Vec2& uv, double error) {
    return visit_round(shape, [&](const auto& s) { return sample(s, uv, error); });
}

Vec2 round_coordinates(const Shape& shape, const Vec3& position) {
    return visit_round(shape, [&](const auto& s) { return coordinates(s, position); });
}

double round_area(const Shape& shape) {
    return visit_round(shape, [](const auto& s) { return area(s); });
}

}  // namespace neumann
