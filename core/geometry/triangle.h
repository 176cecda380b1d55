// A triangle as hits and samples on it need it. Scene units.
#pragma once

#include "core/base/vec.h"

#include <algorithm>

namespace neumann {

class Triangle {
public:
    // `error`: how far rounding to float moves a hit. The triangle must have an area.
    Triangle(const Vec3& a, const Vec3& b, const Vec3& c, double error);

    // The point with barycentric weights u of the second vertex and v of the third, or beside it where that is too near an edge.
    Vec3 at(double u, double v) const {
        return std::min({u, v, 1.0 - u - v}) >= margin_ ? vertex_ + edge1_ * u + edge2_ * v : at_edge(u, v);
    }
    // The barycentric weights of the second and third vertex for a point in the triangle's plane.
    Vec2 weights(const Vec3& p) const {
        const Vec3 x = p - vertex_;
        const double scale = 0.5 / area_;
        return {glm::dot(x, glm::cross(edge2_, normal_)) * scale, glm::dot(x, glm::cross(normal_, edge1_)) * scale};
    }
    const Vec3& normal() const { return normal_; }
    double error() const { return error_; }
    double area() const { return area_; }

    // Where a ray hits that Embree says hits at (u, v): in double, unless the two do not agree on the triangle.
    Vec3 hit(const Vec3& origin, const Vec3& direction, float u, float v) const {
        const double distance = glm::dot(vertex_ - origin, normal_) / glm::dot(direction, normal_);
        const Vec3 p = origin + direction * distance;
        const Vec2 w = weights(p);
        const bool inside = std::min({w.x, w.y, 1.0 - w.x - w.y}) >= margin_ && distance > 0.0 && rounding_ < 1.0f;
        return inside ? p : hit_at_edge(w, distance, u, v);
    }

private:
    Vec3 at_edge(double u, double v) const;
    Vec3 hit_at_edge(const Vec2& weights, double distance, float u, float v) const;

    // A scene has millions of these: what follows from them in a few operations is not kept.
    Vec3 vertex_, edge1_, edge2_, normal_;
    double area_, error_;
    float rounding_;  // of Embree's hits, as a barycentric weight; 1 where the triangle is too thin to have a hit in double
    float margin_;    // hits keep this barycentric distance from the edges, so that rounding cannot push them through a wall that
                      // meets the triangle there; 0 where the triangle is too thin for that
};

}  // namespace neumann
