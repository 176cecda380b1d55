#include "core/geometry/triangle.h"

namespace neumann {

Triangle::Triangle(const Vec3& a, const Vec3& b, const Vec3& c, double error)
    : vertex_(a), edge1_(b - a), edge2_(c - a), error_(error) {
    const Vec3 across = glm::cross(edge1_, edge2_);
    const double twice = glm::length(across), longest = std::max({glm::length(edge1_), glm::length(edge2_), glm::length(c - b)});
    normal_ = across / twice;
    area_ = 0.5 * twice;
    const double rounding = 4.0 * error * longest / twice;
    rounding_ = rounding < 0.05 ? static_cast<float>(rounding) : 1.0f;
    margin_ = rounding < 1e-3 ? static_cast<float>(rounding) : 0.0f;
}

Vec3 Triangle::at_edge(double u, double v) const {
    const double margin = margin_, w = std::max(1.0 - u - v, margin);
    u = std::max(u, margin);
    v = std::max(v, margin);
    const double sum = u + v + w;
    return vertex_ + edge1_ * (u / sum) + edge2_ * (v / sum);
}

Vec3 Triangle::hit_at_edge(const Vec2& weights, double distance, float embree_u, float embree_v) const {
    const double u = weights.x, v = weights.y;
    // Near an edge doubles may find the hit a little outside; along a grazing ray, anywhere.
    if (std::min({u, v, 1.0 - u - v}) >= -rounding_ && distance > 0.0 && rounding_ < 1.0f) return at_edge(u, v);
    return at(embree_u, embree_v);
}

}  // namespace neumann
