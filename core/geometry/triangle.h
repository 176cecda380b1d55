// A triangle as hits and samples on it need it. Scene units.
#pragma once

#include "core/base/vec.h"

#include <algorithm>

namespace neumann {

class Triangle {
public:
    // What the mesh knows and hits seldom need: from the first vertex to the second and to the third.
    struct Edges {
        Vec3 first, second;
    };

    // `error`: how far rounding to float moves a hit. The triangle must have an area.
    Triangle(const Vec3& vertex, const Edges& edges, double error);

    // The point with barycentric weights u of the second vertex and v of the third, or beside it where that is too near an edge.
    Vec3 at(double u, double v, const Edges& edges) const {
        return std::min({u, v, 1.0 - u - v}) >= margin_ ? vertex_ + edges.first * u + edges.second * v : at_edge(u, v, edges);
    }
    // The point of the triangle's plane nearest to p, or one beside it where that is too near an edge. `edges()` is called only then.
    template <class EdgesOf>
    Vec3 at(const Vec3& p, const EdgesOf& edges) const {
        const Vec2 w = weights(p);
        const bool inside = std::min({w.x, w.y, 1.0 - w.x - w.y}) >= margin_;
        return inside ? p - normal_ * glm::dot(p - vertex_, normal_) : at_edge(w.x, w.y, edges());
    }
    // The barycentric weights of the second and third vertex for a point in the triangle's plane.
    Vec2 weights(const Vec3& p) const { return {glm::dot(p - vertex_, dual1_), glm::dot(p - vertex_, dual2_)}; }
    const Vec3& normal() const { return normal_; }
    double error() const { return error_; }
    double area() const { return area_; }

    // Where a ray hits that Embree says hits at (u, v): in double, unless the two do not agree on the triangle. `edges()` is called
    // only then.
    template <class EdgesOf>
    Vec3 hit(const Vec3& origin, const Vec3& direction, float u, float v, const EdgesOf& edges) const {
        const double distance = glm::dot(vertex_ - origin, normal_) / glm::dot(direction, normal_);
        const Vec3 p = origin + direction * distance;
        const Vec2 w = weights(p);
        const bool inside = std::min({w.x, w.y, 1.0 - w.x - w.y}) >= margin_ && distance > 0.0 && rounding_ < 1.0f;
        return inside ? p : hit_at_edge(w, distance, u, v, edges());
    }

private:
    Vec3 at_edge(double u, double v, const Edges& edges) const;
    Vec3 hit_at_edge(const Vec2& weights, double distance, float embree_u, float embree_v, const Edges& edges) const;

    // A scene has millions of these: what the mesh tells is not kept.
    Vec3 vertex_, normal_;
    Vec3 dual1_, dual2_;  // weights of a point x: dot(x − vertex, dual)
    double area_, error_;
    float rounding_;  // of Embree's hits, as a barycentric weight; 1 where the triangle is too thin to have a hit in double
    float margin_;    // hits keep this barycentric distance from the edges, so that rounding cannot push them through a wall that
                      // meets the triangle there; 0 where the triangle is too thin for that
};

}  // namespace neumann
