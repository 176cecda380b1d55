#include "core/geometry/double_faces.h"

#include "core/geometry/rounding.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace neumann {

namespace {

double rounding_at(const Vec3& p, const Vec3& other) { return double_rounding(p, largest_component(other)); }

// How far outside its rim a ray from p still hits a face: if two faces share an edge, the ray must hit at least one of them.
double rim_rounding(const Vec3& p, const Vec3& face, double distance) {
    return 4.0 * double_rounding(p, largest_component(face) + distance);
}

// Components of p − base along the axis and perpendicular to it.
struct Cylindrical {
    double along;
    Vec3 across;
};
Cylindrical in_cylinder(const Cylinder& c, const Vec3& p) {
    const Vec3 f = p - c.base;
    const double along = glm::dot(f, c.axis);
    return {along, f - c.axis * along};
}

// √(a² + b²) for p = center + a·u + b·v + …·normal.
double radius_in_disk(const Disk& d, const Vec3& p) {
    const Vec3 f = p - d.center;
    const double uu = glm::dot(d.u, d.u), uv = glm::dot(d.u, d.v), vv = glm::dot(d.v, d.v), gram = uu * vv - uv * uv;
    return std::hypot(glm::dot(f, (d.u * vv - d.v * uv) / gram), glm::dot(f, (d.v * uu - d.u * uv) / gram));
}
double least_half_axis(const Disk& d) { return glm::length(glm::cross(d.u, d.v)) / std::hypot(glm::length(d.u), glm::length(d.v)); }

// The distances > 0 at which |across + t·d_across| = radius, without the one where the ray starts.
int meet_round(const Vec3& across, const Vec3& d_across, double radius, bool starts_there, double (&t)[2]) {
    const double a = glm::dot(d_across, d_across);
    if (!(a > 0.0)) return 0;
    const double middle = -glm::dot(across, d_across) / a;
    if (starts_there) {
        t[0] = 2.0 * middle;
        return t[0] > 0.0;
    }
    const Vec3 nearest = across + d_across * middle;
    const double square = radius * radius - glm::dot(nearest, nearest);
    if (!(square >= 0.0)) return 0;
    const double half = std::sqrt(square / a);
    int n = 0;
    for (const double distance : {middle - half, middle + half})
        if (distance > 0.0) t[n++] = distance;
    return n;
}

}  // namespace

std::array<Vec3, 3> DoubleFaces::vertices(const Face& f) const {
    const auto& mesh = std::get<TriangleMesh>((*shapes_)[f.shape]);
    const auto& t = mesh.triangles[f.primitive];
    return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

Bounds DoubleFaces::bounds(const Face& f) const {
    if (!triangle(f)) return bounds_of((*shapes_)[f.shape]);
    Bounds bounds;
    for (const Vec3& v : vertices(f)) bounds.add(v);
    return bounds;
}

std::vector<Face> DoubleFaces::all() const {
    std::vector<Face> faces;
    for (std::uint32_t shape = 0; shape < shapes_->size(); ++shape) {
        const auto* mesh = std::get_if<TriangleMesh>(&(*shapes_)[shape]);
        const std::size_t n = mesh ? mesh->triangles.size() : has_extent((*shapes_)[shape]);
        for (std::uint32_t i = 0; i < n; ++i) faces.push_back({shape, i});
    }
    return faces;
}

bool DoubleFaces::is_near(const Face& f, const Vec3& p, double distance) const {
    if (const Triangle* t = triangle(f)) {
        if (!(std::abs(glm::dot(p - t->vertex(), t->normal())) <= distance)) return false;
        const Vec2 w = t->weights(p);
        return w.x >= -distance * glm::length(t->dual1()) && w.y >= -distance * glm::length(t->dual2()) &&
               1.0 - w.x - w.y >= -distance * glm::length(t->dual1() + t->dual2());
    }
    const Shape& shape = (*shapes_)[f.shape];
    if (const auto* sphere = std::get_if<Sphere>(&shape))
        return std::abs(glm::length(p - sphere->center) - sphere->radius) <= distance;
    if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
        const auto [along, across] = in_cylinder(*cylinder, p);
        return std::abs(glm::length(across) - cylinder->radius) <= distance && along >= -distance &&
               along <= cylinder->length + distance;
    }
    const Disk& disk = std::get<Disk>(shape);
    return std::abs(glm::dot(p - disk.center, disk.normal)) <= distance &&
           radius_in_disk(disk, p) <= 1.0 + distance / least_half_axis(disk);
}

bool DoubleFaces::holds(const Face& f, const Vec3& p) const {
    if (const Triangle* t = triangle(f)) return std::abs(glm::dot(p - t->vertex(), t->normal())) <= rounding_at(p, t->vertex());
    const Shape& shape = (*shapes_)[f.shape];
    if (const auto* sphere = std::get_if<Sphere>(&shape))
        return std::abs(glm::length(p - sphere->center) - sphere->radius) <= rounding_at(p, sphere->center + sphere->radius);
    if (const auto* cylinder = std::get_if<Cylinder>(&shape))
        return std::abs(glm::length(in_cylinder(*cylinder, p).across) - cylinder->radius) <=
               rounding_at(p, glm::abs(cylinder->base) + cylinder->length + cylinder->radius);
    const Disk& disk = std::get<Disk>(shape);
    return std::abs(glm::dot(p - disk.center, disk.normal)) <= rounding_at(p, disk.center);
}

int DoubleFaces::meet(const Face& f, const RayStart& start, const Vec3& direction, double (&distances)[2]) const {
    const Vec3& p = start.position;
    const bool starts_there = start.face == f || holds(f, p);
    if (const Triangle* t = triangle(f)) {
        if (starts_there) return 0;
        const auto [cosine, distance, position, w] = t->meet(p, direction);
        distances[0] = distance;
        if (!(distances[0] > 0.0)) return 0;
        const double rounding = rim_rounding(p, t->vertex(), distances[0]);
        return w.x >= -rounding * glm::length(t->dual1()) && w.y >= -rounding * glm::length(t->dual2()) &&
               1.0 - w.x - w.y >= -rounding * glm::length(t->dual1() + t->dual2());
    }
    const Shape& shape = (*shapes_)[f.shape];
    if (const auto* sphere = std::get_if<Sphere>(&shape))
        return meet_round(p - sphere->center, direction, sphere->radius, starts_there, distances);
    if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
        const auto [along, across] = in_cylinder(*cylinder, p);
        const double d_along = glm::dot(direction, cylinder->axis);
        const int met = meet_round(across, direction - cylinder->axis * d_along, cylinder->radius, starts_there, distances);
        int n = 0;
        for (int i = 0; i < met; ++i) {
            const double at = along + distances[i] * d_along,
                         rounding = rim_rounding(p, cylinder->base, cylinder->length + distances[i]);
            if (at >= -rounding && at <= cylinder->length + rounding) distances[n++] = distances[i];
        }
        return n;
    }
    if (starts_there) return 0;
    const Disk& disk = std::get<Disk>(shape);
    distances[0] = glm::dot(disk.normal, disk.center - p) / glm::dot(disk.normal, direction);
    const double rounding = rim_rounding(p, disk.center, distances[0]);
    return distances[0] > 0.0 && radius_in_disk(disk, p + direction * distances[0]) <= 1.0 + rounding / least_half_axis(disk);
}

}  // namespace neumann
