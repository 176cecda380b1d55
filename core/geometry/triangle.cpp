#include "core/geometry/triangle.h"

#include <algorithm>

namespace neumann {

Triangle::Triangle(const Vec3& vertex, const Edges& edges, double error) : vertex_(vertex), error_(error) {
    const Vec3 across = glm::cross(edges.first, edges.second);
    const double twice = glm::length(across);
    const double longest = std::max({glm::length(edges.first), glm::length(edges.second), glm::length(edges.second - edges.first)});
    normal_ = across / twice;
    area_ = 0.5 * twice;
    dual1_ = glm::cross(edges.second, normal_) / twice;
    dual2_ = glm::cross(normal_, edges.first) / twice;
    const double rounding = 4.0 * error * longest / twice;
    rounding_ = rounding < 0.05 ? static_cast<float>(rounding) : 1.0f;
    margin_ = rounding < 1e-3 ? static_cast<float>(rounding) : 0.0f;
}

Vec3 Triangle::at_edge(double u, double v, const Edges& edges) const {
    const double margin = margin_, w = std::max(1.0 - u - v, margin);
    u = std::max(u, margin);
    v = std::max(v, margin);
    const double sum = u + v + w;
    return vertex_ + edges.first * (u / sum) + edges.second * (v / sum);
}

Vec3 Triangle::hit_at_edge(const Vec2& weights, double distance, float embree_u, float embree_v, const Edges& edges) const {
    const double u = weights.x, v = weights.y;
    // Near an edge doubles may find the hit a little outside; along a grazing ray, anywhere.
    if (std::min({u, v, 1.0 - u - v}) >= -rounding_ && distance > 0.0 && rounding_ < 1.0f) return at_edge(u, v, edges);
    return at(embree_u, embree_v, edges);
}

}  // namespace neumann
