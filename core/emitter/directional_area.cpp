#include "core/emitter/directional_area.h"

#include "core/base/error.h"

#include <algorithm>
#include <utility>

namespace neumann {

bool is_flat(const Shape& shape) {
    if (std::holds_alternative<Disk>(shape)) return true;
    const auto* mesh = std::get_if<TriangleMesh>(&shape);
    if (!mesh) return false;
    constexpr double tolerance = 1e-6;
    // The largest triangle has the most accurate normal.
    Vec3 corner(0.0), largest(0.0);
    Bounds bounds;
    for (std::uint32_t i = 0; i < mesh->triangles.size(); ++i) {
        const TriangleCorners t = corners_of(*mesh, i);
        const Vec3 n = glm::cross(t.at[1] - t.at[0], t.at[2] - t.at[0]);
        for (const Vec3& p : t.at) bounds.add(p);
        if (glm::length(n) <= glm::length(largest)) continue;
        largest = n;
        corner = t.at[0];
    }
    if (largest == Vec3(0.0)) return true;
    const Vec3 normal = glm::normalize(largest);
    for (std::uint32_t i = 0; i < mesh->triangles.size(); ++i) {
        const TriangleCorners t = corners_of(*mesh, i);
        if (glm::dot(glm::cross(t.at[1] - t.at[0], t.at[2] - t.at[0]), normal) < 0.0) return false;
        for (std::size_t k = 0; k < 3; ++k) {
            if (std::abs(glm::dot(t.at[k] - corner, normal)) > tolerance * bounds.radius()) return false;
            if (!mesh->normals.empty() && glm::dot(glm::normalize(mesh->normals[t.vertices[k]]), normal) < 1.0 - tolerance)
                return false;
        }
    }
    return true;
}

DirectionalArea::DirectionalArea(const Geometry& geometry, std::uint32_t shape, AreaLight light)
    : shapes_(geometry.shared_shapes()), shape_(shape), light_(std::move(light)), area_(geometry.area(shape)) {
    if (!is_flat((*shapes_)[shape])) throw InputError("emitter 'directionalarea' on a shape that is not flat");
    const SurfacePoint p = geometry.point(shape, 0, Vec2(0.5));
    corner_ = p.position;
    normal_ = p.normal;
    error_ = p.error;
    double sum = 0.0;
    if (const auto* mesh = std::get_if<TriangleMesh>(&(*shapes_)[shape]))
        for (std::uint32_t i = 0; i < mesh->triangles.size(); ++i) {
            const auto& [a, b, c] = corners_of(*mesh, i).at;
            triangles_.emplace_back(a, b, c, error_);
            cumulative_.push_back(sum += Triangle::area(a, b, c));
        }
}

std::optional<SurfacePoint> DirectionalArea::foot(const Vec3& p) const {
    SurfacePoint below{p - normal_ * height(p), normal_, error_, shape_, 0};
    if (const auto* disk = std::get_if<Disk>(&(*shapes_)[shape_])) {
        const Vec2 c = disk->coordinates(below.position);
        return glm::dot(c, c) <= 1.0 ? std::optional(below) : std::nullopt;
    }
    const auto holds = [&](const Triangle& t) {
        constexpr double rounding = 1e-12;  // between two triangles there is no gap
        const Vec2 w = t.weights(below.position);
        return std::min({w.x, w.y, 1.0 - w.x - w.y}) >= -rounding;
    };
    const auto found = std::find_if(triangles_.begin(), triangles_.end(), holds);
    if (found == triangles_.end()) return std::nullopt;
    below.primitive = static_cast<std::uint32_t>(found - triangles_.begin()) & 0x7fffffffu;
    return below;
}

Rgb DirectionalArea::exitance(const Vec3& at) const {
    const auto below = foot(at);
    if (!below) return Rgb(0.0);
    return light_.function ? light_.function(shading_point((*shapes_)[shape_], *below), normal_) : light_.largest;
}

Beam DirectionalArea::beam(const Vec3& at, const Surroundings&) const {
    if (!is_in_front(at)) return {at - normal_};
    // The shadow ray ends off the surface, by the surface's rounding error.
    return {at - normal_ * (height(at) - error_), exitance(at)};
}

Vec3 DirectionalArea::start(const Vec2& u) const {
    Vec3 p;
    if (const auto* disk = std::get_if<Disk>(&(*shapes_)[shape_])) {
        const Vec2 at = uniform_disk(u);
        p = disk->center + disk->u * at.x + disk->v * at.y;
    } else {
        const double wanted = u.x * cumulative_.back();
        const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, wanted);
        const auto i = static_cast<std::uint32_t>(found - cumulative_.begin());
        const double below = i == 0 ? 0.0 : cumulative_[i - 1];
        const Vec2 weights = uniform_triangle({std::clamp((wanted - below) / (*found - below), 0.0, 1.0), u.y});
        const auto& [a, b, c] = corners_of((*shapes_)[shape_], i).at;
        p = a + (b - a) * weights.x + (c - a) * weights.y;
    }
    return p + normal_ * error_;
}

}  // namespace neumann
