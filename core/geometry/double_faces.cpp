#include "core/geometry/double_faces.h"

#include "core/geometry/rounding.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace neumann {

namespace {

double rounding_at(const Vec3& p, const Vec3& other) { return double_rounding(p, largest_component(other)); }

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
    const Vec2 at = d.coordinates(p);
    return std::hypot(at.x, at.y);
}
double least_half_axis(const Disk& d) { return glm::length(glm::cross(d.u, d.v)) / std::hypot(glm::length(d.u), glm::length(d.v)); }

// How a ray passes an edge of a face: on its inner side, by this distance, which has this rounding error.
struct Passing {
    Vec3 inwards;  // perpendicular to the ray and to the edge
    double distance, rounding;

    bool is_inside(double roundings) const { return distance >= -roundings * rounding; }
    bool is_close() const { return std::abs(distance) <= DoubleFaces::unsure * rounding; }
};

// `inner` is a place on the edge's inner side. If a ray is nearly parallel to the edge, it is hard to tell on which side it is.
Passing pass(const Vec3& p, const Vec3& direction, const Vec3& on_edge, const Vec3& along, const Vec3& inner, double rounding) {
    const Vec3 n = glm::cross(along, direction);
    const double length = glm::length(n);
    const Vec3 inwards = n / (glm::dot(n, inner - on_edge) < 0.0 ? -length : length);
    return {inwards, glm::dot(inwards, p - on_edge), rounding * glm::length(along) / length};
}

// How the ray from p that meets the plane or surface of a face at `distance` passes the edges of the face.
class Passings {
public:
    Passings(const std::array<Vec3, 3>& v, const Vec3& p, const Vec3& direction, double distance) {
        const double rounding = double_rounding(p, largest_component(v[0]) + distance);
        for (int i = 0; i < 3; ++i) {
            const Vec3 &a = v[i], &b = v[(i + 1) % 3], &c = v[(i + 2) % 3];
            add(pass(p, direction, a, b - a, c, rounding));
        }
    }
    Passings(const Disk& disk, const Vec3& p, const Vec3& direction, double distance) {
        const double rounding =
            double_rounding(p, largest_component(disk.center) + glm::length(disk.u) + glm::length(disk.v) + distance);
        const Vec2 at = disk.coordinates(p + direction * distance);
        const double angle = std::atan2(at.y, at.x), cosine = std::cos(angle), sine = std::sin(angle);
        add(pass(p, direction, disk.center + disk.u * cosine + disk.v * sine, disk.v * cosine - disk.u * sine, disk.center,
                 rounding));
    }
    Passings(const Cylinder& cylinder, const Vec3& p, const Vec3& direction, double distance) {
        const double rounding = double_rounding(p, largest_component(cylinder.base) + cylinder.length + distance);
        const Vec3 center = cylinder.center(), across = in_cylinder(cylinder, p + direction * distance).across;
        for (const double end : {0.0, cylinder.length})
            add(pass(p, direction, cylinder.base + cylinder.axis * end + across, glm::cross(cylinder.axis, across), center + across,
                     rounding));
    }

    const Passing* begin() const { return edges_.data(); }
    const Passing* end() const { return edges_.data() + size_; }
    bool are_inside(double roundings) const {
        return std::all_of(begin(), end(), [&](const Passing& edge) { return edge.is_inside(roundings); });
    }

private:
    void add(const Passing& passing) { edges_[size_++] = passing; }

    std::array<Passing, 3> edges_;
    std::size_t size_ = 0;
};

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

TriangleOfFace DoubleFaces::triangle_of_instance(const Face& f) const {
    const auto* instance = std::get_if<MeshInstance>(&(*shapes_)[f.shape]);
    if (!instance) return nullptr;
    const TriangleCorners corners = corners_of(*instance, f.primitive);
    return TriangleOfFace(Triangle(corners.at[0], corners.at[1], corners.at[2], errors_[f.shape]));
}

Bounds DoubleFaces::bounds(const Face& f) const {
    const Shape& shape = (*shapes_)[f.shape];
    return is_triangle(f) ? corners_of(shape, f.primitive).bounds() : bounds_of(shape);
}

void DoubleFaces::prefetch_corners(const Face& f) const {
    if (triangles_[f.shape].empty()) return;
    const TriangleMesh& mesh = std::get<TriangleMesh>((*shapes_)[f.shape]);
    for (const std::uint32_t vertex : mesh.triangles[f.primitive]) __builtin_prefetch(&mesh.vertices[vertex]);
}

double DoubleFaces::size_at_most(const Face& f) const {
    const TriangleOfFace t = triangle(f);
    if (!t) return size(f);
    // Gradients of weights are edges turned by a right angle, divided by twice the area.
    const Vec3 &a = t->dual1(), &b = t->dual2();
    const double longest = std::max({glm::length(a), glm::length(b), glm::length(a + b)}) / glm::length(glm::cross(a, b));
    return std::isfinite(longest) ? std::sqrt(3.0) * longest : size(f);
}

std::vector<Face> DoubleFaces::all() const {
    std::vector<Face> faces;
    for (std::uint32_t shape = 0; shape < shapes_->size(); ++shape) {
        if (is_of_instance({shape, 0})) continue;
        const auto* mesh = std::get_if<TriangleMesh>(&(*shapes_)[shape]);
        const std::size_t n = mesh ? mesh->triangles.size() : has_extent((*shapes_)[shape]);
        for (std::uint32_t i = 0; i < n; ++i) faces.push_back({shape, i});
    }
    return faces;
}

bool DoubleFaces::is_near(const Face& f, const Vec3& p, double distance) const {
    if (const TriangleOfFace t = triangle(f)) {
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

DoubleFaces::Height DoubleFaces::height(const Face& f, const Vec3& p) const {
    const auto above_plane = [&](const Vec3& on_plane, const Vec3& normal) {
        return Height{normal, glm::dot(p - on_plane, normal), rounding_at(p, on_plane)};
    };
    const auto above_round = [&](const Vec3& across, double radius, double rounding) {
        const double length = glm::length(across);
        return Height{across / length, length - radius, rounding};
    };
    if (const TriangleOfFace t = triangle(f)) return above_plane(t->vertex(), t->normal());
    const Shape& shape = (*shapes_)[f.shape];
    if (const auto* sphere = std::get_if<Sphere>(&shape))
        return above_round(p - sphere->center, sphere->radius, rounding_at(p, sphere->center + sphere->radius));
    if (const auto* cylinder = std::get_if<Cylinder>(&shape))
        return above_round(in_cylinder(*cylinder, p).across, cylinder->radius,
                           rounding_at(p, glm::abs(cylinder->base) + cylinder->length + cylinder->radius));
    const Disk& disk = std::get<Disk>(shape);
    return above_plane(disk.center, disk.normal);
}

int DoubleFaces::meet(const Face& f, const RayStart& start, const Vec3& direction, double (&distances)[2], double roundings) const {
    const Vec3& p = start.position;
    const bool starts_there = start.face == f || holds(f, p);
    const TriangleOfFace t = triangle(f);
    if (starts_there && t) return 0;
    const auto is_hit = [&](const auto& face, double distance) {
        return distance > 0.0 && Passings(face, p, direction, distance).are_inside(roundings);
    };
    if (t) {
        distances[0] = t->meet(p, direction).distance;
        return is_hit(vertices(f), distances[0]);
    }
    const Shape& shape = (*shapes_)[f.shape];
    if (const auto* sphere = std::get_if<Sphere>(&shape))
        return meet_round(p - sphere->center, direction, sphere->radius, starts_there, distances);
    if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
        const Vec3 across = in_cylinder(*cylinder, p).across,
                   d_across = direction - cylinder->axis * glm::dot(direction, cylinder->axis);
        const int met = meet_round(across, d_across, cylinder->radius, starts_there, distances);
        return static_cast<int>(std::remove_if(distances, distances + met, [&](double d) { return !is_hit(*cylinder, d); }) -
                                distances);
    }
    if (starts_there) return 0;
    const Disk& disk = std::get<Disk>(shape);
    distances[0] = glm::dot(disk.normal, disk.center - p) / glm::dot(disk.normal, direction);
    return is_hit(disk, distances[0]);
}

std::optional<Vec3> DoubleFaces::off_edge(const Face& f, const Vec3& p, const Vec3& direction, double distance) const {
    const auto off = [&](const Passings& edges) -> std::optional<Vec3> {
        Vec3 inwards(0.0);
        for (const Passing& edge : edges)
            if (edge.is_close()) inwards += edge.inwards * (2.0 * unsure * edge.rounding);
        if (inwards == Vec3(0.0)) return std::nullopt;
        return inwards;
    };
    if (is_triangle(f)) return off({vertices(f), p, direction, distance});
    const Shape& shape = (*shapes_)[f.shape];
    if (const auto* cylinder = std::get_if<Cylinder>(&shape)) return off({*cylinder, p, direction, distance});
    if (const auto* disk = std::get_if<Disk>(&shape)) return off({*disk, p, direction, distance});
    return std::nullopt;
}

}  // namespace neumann
