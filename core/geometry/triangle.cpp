#include "core/geometry/triangle.h"

namespace neumann {

Triangle::Triangle(const Vec3& a, const Vec3& b, const Vec3& c, double error)
    : vertex_(a), edge1_(b - a), edge2_(c - a), error_(error) {
    const Vec3 across = glm::cross(edge1_, edge2_);
    const double twice = glm::length(across), longest = std::max({glm::length(edge1_), glm::length(edge2_), glm::length(c - b)});
    normal_ = across / twice;
    area_ = 0.5 * twice;
    dual1_ = glm::cross(edge2_, normal_) / twice;
    dual2_ = glm::cross(normal_, edge1_) / twice;
    const double rounding = 4.0 * error * longest / twice;
    rounding_ = rounding < 0.05 ? rounding : 1.0;
    margin_ = rounding < 1e-3 ? rounding : 0.0;
}

Vec3 Triangle::at_edge(double u, double v) const {
    const double w = std::max(1.0 - u - v, margin_);
    u = std::max(u, margin_);
    v = std::max(v, margin_);
    const double sum = u + v + w;
    return vertex_ + edge1_ * (u / sum) + edge2_ * (v / sum);
}

Vec3 Triangle::hit_at_edge(const Vec2& weights, double distance, float embree_u, float embree_v) const {
    const double u = weights.x, v = weights.y;
    // Near an edge doubles may find the hit a little outside; along a grazing ray, anywhere.
    if (std::min({u, v, 1.0 - u - v}) >= -rounding_ && distance > 0.0 && rounding_ < 1.0) return at_edge(u, v);
    return at(embree_u, embree_v);
}

}  // namespace neumann
