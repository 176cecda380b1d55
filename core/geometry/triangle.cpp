#include "core/geometry/triangle.h"

#include "core/geometry/rounding.h"

#include <algorithm>

namespace neumann {

static_assert(sizeof(Triangle) == 128);

namespace {

constexpr Vec3 no_normal(0.0, 0.0, 1.0);  // for triangles without area

struct Across {
    Vec3 product;  // cross product of two edges: along the normal, with twice the area as its length
    double longest;
};

Across across(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 first = b - a, second = c - a, third = c - b, product = glm::cross(first, second);
    const double lengths[] = {glm::length(first), glm::length(second), glm::length(third)};
    const double longest = std::max({lengths[0], lengths[1], lengths[2]});
    // In a thin triangle, two long edges are nearly parallel.
    constexpr double thin = 1.0 / 256.0;
    if (glm::length(product) >= thin * longest * longest || longest == lengths[2]) return {product, longest};
    return {longest == lengths[0] ? glm::cross(third, -second) : glm::cross(first, third), longest};
}

}  // namespace

Triangle::Triangle(const Vec3& a, const Vec3& b, const Vec3& c, double error) : vertex_(a), error_(error) {
    const Edges edges{b - a, c - a};
    const auto [product, longest] = across(a, b, c);
    const double twice = glm::length(product);
    // An instance's triangle that is too thin for doubles where it is placed is hit by no ray in double.
    if (!(twice > 0.0)) {
        normal_ = no_normal;
        dual1_ = dual2_ = Vec3(0.0);
        rounding_ = 1.0f;
        margin_ = 0.0f;
        return;
    }
    normal_ = product / twice;
    dual1_ = glm::cross(edges.second, normal_) / twice;
    dual2_ = glm::cross(normal_, edges.first) / twice;
    const double rounding = 4.0 * error * longest / twice;
    rounding_ = rounding < 0.05 ? static_cast<float>(rounding) : 1.0f;
    const double margin = 64.0 * double_rounding(a, longest) * longest / twice;
    margin_ = margin < 1e-3 ? static_cast<float>(margin) : 0.0f;
}

double Triangle::area(const Vec3& a, const Vec3& b, const Vec3& c) { return 0.5 * glm::length(across(a, b, c).product); }

Vec3 Triangle::normal(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 product = across(a, b, c).product;
    const double length = glm::length(product);
    return length > 0.0 ? product / length : no_normal;
}

Vec3 Triangle::at_edge(double u, double v, const Edges& edges) const {
    const double margin = margin_, w = std::max(1.0 - u - v, margin);
    u = std::max(u, margin);
    v = std::max(v, margin);
    const double sum = u + v + w;
    return vertex_ + edges.first * (u / sum) + edges.second * (v / sum);
}

Vec3 Triangle::near(const Meeting& m, float embree_u, float embree_v, const Edges& edges) const {
    const double u = m.weights.x, v = m.weights.y;
    // In double, the hit may be a little outside near an edge, and anywhere for a grazing ray.
    if (std::min({u, v, 1.0 - u - v}) >= -rounding_ && m.distance > 0.0 && rounding_ < 1.0f) return at_edge(u, v, edges);
    return at(embree_u, embree_v, edges);
}

}  // namespace neumann
