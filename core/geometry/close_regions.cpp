#include "core/geometry/close_regions.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace neumann {

namespace {

// A convex polygon: a triangle clipped by half-spaces.
class Polygon {
public:
    explicit Polygon(const std::array<Vec3, 3>& corners) : size_(3) { std::copy(corners.begin(), corners.end(), corners_.begin()); }

    // Keeps the part with dot(n, x − from) ≤ most.
    void cut(const Vec3& n, const Vec3& from, double most) {
        std::array<Vec3, capacity> kept;
        std::size_t size = 0;
        for (std::size_t i = 0; i < size_; ++i) {
            const Vec3 &a = corners_[i], &b = corners_[(i + 1) % size_];
            const double da = glm::dot(n, a - from) - most, db = glm::dot(n, b - from) - most;
            if (da <= 0.0) kept[size++] = a;
            if ((da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0)) kept[size++] = a + (b - a) * (da / (da - db));
        }
        corners_ = kept;
        size_ = size;
    }
    void cut(const Bounds& box) {
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 n(0.0);
            n[axis] = 1.0;
            cut(n, box.high, 0.0);
            cut(-n, box.low, 0.0);
        }
    }
    std::span<const Vec3> corners() const { return {corners_.data(), size_}; }

private:
    // A cut adds at most one corner, and there are up to 6 cuts for a box and 2 for a disc. After rounding the polygon may not be
    // quite convex, which adds at most two more corners per cut.
    static constexpr std::size_t capacity = 3 + 3 * 8;
    std::array<Vec3, capacity> corners_;
    std::size_t size_;
};

// Bounds of the part of a plane that is within `distance` of the sphere, around the circle where they intersect.
std::optional<Bounds> around_circle(const Sphere& sphere, const Vec3& on_plane, const Vec3& normal, double distance) {
    const double h = glm::dot(sphere.center - on_plane, normal);
    const double least = std::max(std::abs(h) - distance, 0.0), most = sphere.radius + distance;
    if (least > most) return std::nullopt;
    const double radius = std::sqrt(most * most - least * least);
    const Vec3 center = sphere.center - normal * h;
    const Vec3 extent = glm::sqrt(glm::max(1.0 - normal * normal, 0.0)) * radius + 2.0 * distance;
    return Bounds{center - extent, center + extent};
}

bool inside(const std::array<Vec3, 3>& corners, const Sphere& s, double distance) {
    return std::all_of(corners.begin(), corners.end(),
                       [&](const Vec3& c) { return glm::length(c - s.center) < s.radius - distance; });
}

bool inside(const std::array<Vec3, 3>& corners, const Cylinder& cylinder, double distance) {
    return std::all_of(corners.begin(), corners.end(), [&](const Vec3& c) {
        const Vec3 f = c - cylinder.base;
        return glm::length(f - cylinder.axis * glm::dot(f, cylinder.axis)) < cylinder.radius - distance;
    });
}

void cut_to_triangle(Polygon& polygon, const Triangle& b, double distance) {
    polygon.cut(b.normal(), b.vertex(), distance);
    polygon.cut(-b.normal(), b.vertex(), distance);
    const Vec3 third = b.dual1() + b.dual2();
    polygon.cut(-b.dual1(), b.vertex(), distance * glm::length(b.dual1()));
    polygon.cut(-b.dual2(), b.vertex(), distance * glm::length(b.dual2()));
    polygon.cut(third, b.vertex(), 1.0 + distance * glm::length(third));
}

std::optional<CloseRegion> region_of_triangle(const DoubleFaces& faces, const Face& a, const Face& b, double distance) {
    const std::array<Vec3, 3> corners = faces.vertices(a);
    const TriangleOfFace of_a = faces.triangle(a);
    const Triangle& t = *of_a;
    Polygon polygon(corners);
    if (const TriangleOfFace other = faces.triangle(b)) {
        cut_to_triangle(polygon, *other, distance);
    } else {
        const Shape& shape = faces.shapes()[b.shape];
        if (const auto* sphere = std::get_if<Sphere>(&shape)) {
            if (inside(corners, *sphere, distance)) return std::nullopt;
            const auto circle = around_circle(*sphere, t.vertex(), t.normal(), distance);
            if (!circle) return std::nullopt;
            polygon.cut(*circle);
        } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
            if (inside(corners, *cylinder, distance)) return std::nullopt;
        } else if (const auto* disk = std::get_if<Disk>(&shape)) {
            polygon.cut(disk->normal, disk->center, distance);
            polygon.cut(-disk->normal, disk->center, distance);
        }
        polygon.cut(faces.bounds(b).grown(distance));
    }
    if (polygon.corners().empty()) return std::nullopt;
    CloseRegion region;
    Vec3 largest(0.0);  // largest weight of each vertex over the polygon's corners
    for (const Vec3& p : polygon.corners()) {
        region.bounds.add(p);
        const Vec2 w = t.weights(p);
        region.weights.push_back(w);
        largest = glm::max(largest, Vec3(w.x, w.y, 1.0 - w.x - w.y));
    }
    region.bounds = region.bounds.grown(distance);
    std::sort(&largest.x, &largest.x + 3);
    region.from_edge = largest.x;
    region.from_corner = largest.y;
    return region;
}

}  // namespace

std::optional<CloseRegion> close_region(const DoubleFaces& faces, const Face& a, const Face& b, double distance) {
    if (faces.is_triangle(a)) return region_of_triangle(faces, a, b, distance);
    Bounds bounds = intersection(faces.bounds(a).grown(distance), faces.bounds(b).grown(distance));
    if (const auto* sphere = std::get_if<Sphere>(&faces.shapes()[a.shape])) {
        if (const TriangleOfFace t = faces.triangle(b)) {
            if (inside(faces.vertices(b), *sphere, distance)) return std::nullopt;
            const auto circle = around_circle(*sphere, t->vertex(), t->normal(), distance);
            if (!circle) return std::nullopt;
            bounds = intersection(bounds, *circle);
        } else if (const auto* other = std::get_if<Sphere>(&faces.shapes()[b.shape])) {
            const double d = glm::length(sphere->center - other->center);
            if (d > sphere->radius + other->radius + distance || d < std::abs(sphere->radius - other->radius) - distance)
                return std::nullopt;
        }
    }
    if (bounds.is_empty()) return std::nullopt;
    return CloseRegion{bounds, 1.0, 1.0, {}};
}

}  // namespace neumann
