// The data of a triangle that hits and samples need. Scene units.
#pragma once

#include "core/base/vec.h"
#include "core/geometry/weight_cells.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace neumann {

// Two cache lines large, because a hit reads nearly all of it.
class alignas(64) Triangle {
public:
    // Edges from the first vertex to the second and to the third. They come from the mesh, because hits seldom need them.
    struct Edges {
        Vec3 first, second;
    };

    // `error` is how far rounding to float moves a hit. The triangle must have an area.
    Triangle(const Vec3& a, const Vec3& b, const Vec3& c, double error);

    // The point with barycentric weights u of the second vertex and v of the third, moved inwards if it is too close to an edge for
    // doubles.
    Vec3 at(double u, double v, const Edges& edges) const {
        return is_inside({u, v}) ? vertex_ + edges.first * u + edges.second * v : at_edge(u, v, edges);
    }
    // The point of the triangle's plane nearest to p, moved in the same way if necessary; only then `edges()` is called.
    template <class EdgesOf>
    Vec3 at(const Vec3& p, const EdgesOf& edges) const {
        const Vec2 w = weights(p);
        return is_inside(w) ? p - normal_ * glm::dot(p - vertex_, normal_) : at_edge(w.x, w.y, edges());
    }
    // The barycentric weights of the second and third vertex for a point in the triangle's plane.
    Vec2 weights(const Vec3& p) const { return {glm::dot(p - vertex_, dual1_), glm::dot(p - vertex_, dual2_)}; }
    const Vec3& vertex() const { return vertex_; }
    const Vec3& normal() const { return normal_; }
    // Gradients of the weights of the second and of the third vertex.
    const Vec3& dual1() const { return dual1_; }
    const Vec3& dual2() const { return dual2_; }
    double error() const { return error_; }
    static double area(const Vec3& a, const Vec3& b, const Vec3& c);
    static Vec3 normal(const Vec3& a, const Vec3& b, const Vec3& c);

    // The intersection of a ray with the triangle's plane, in double.
    struct Meeting {
        double cosine;  // of the ray with the normal
        double distance;
        Vec3 position;
        Vec2 weights;
    };
    Meeting meet(const Vec3& origin, const Vec3& direction) const {
        const double cosine = glm::dot(direction, normal_), distance = glm::dot(vertex_ - origin, normal_) / cosine;
        const Vec3 position = origin + direction * distance;
        return {cosine, distance, position, weights(position)};
    }
    // Whether this intersection is the hit of a ray for which Embree found the triangle. Otherwise use near(…).
    bool is_hit(const Meeting& m) const { return is_inside(m.weights) && m.distance > 0.0 && rounding_ < 1.0f; }
    // Whether the ray passes beside the triangle, by more than hits are moved inwards.
    bool is_missed(const Meeting& m) const {
        return rounding_ < 1.0f &&
               (!(m.distance > 0.0) || std::min({m.weights.x, m.weights.y, 1.0 - m.weights.x - m.weights.y}) < -margin_);
    }
    Vec3 near(const Meeting& m, float embree_u, float embree_v, const Edges& edges) const;

    // These say where another surface may be within rounding: in strips along the edges, where one barycentric weight is small; in
    // corners, where two are; and in cells. Neighbours computes them when they are first needed, and keeps the cells.
    static constexpr double grazing = 0.1;  // rays with a smaller cosine are never clear if there are cells
    // Whether a hit is clear. `cosine` is that of the ray with the normal: the distance to the edges must also cover
    // the displacement of Embree's ray, which grows for grazing rays.
    bool is_clear(const Vec2& w, double cosine = 1.0) const {
        if (is_near_edge(w, cosine)) return false;
        const WeightCells* cells = std::atomic_ref(cells_).load(std::memory_order_relaxed);
        return !cells || (std::abs(cosine) >= grazing && !cells->is_marked(w));
    }
    bool is_near_edge(const Vec2& w, double cosine = 1.0) const {
        const double low = std::min(w.x, w.y), high = std::max(w.x, w.y), third = 1.0 - w.x - w.y;
        return std::min(low, third) * std::abs(cosine) < std::atomic_ref(strip_).load(std::memory_order_acquire) ||
               std::max(low, std::min(high, third)) * std::abs(cosine) < std::atomic_ref(corner_).load(std::memory_order_relaxed);
    }
    bool is_examined() const { return std::atomic_ref(strip_).load(std::memory_order_acquire) < unknown; }
    // Whether so much is around the triangle that its close parts are not kept: no point is clear without a search.
    bool is_crowded() const { return std::atomic_ref(strip_).load(std::memory_order_acquire) == everywhere; }
    void set_crowded() const { set_close(everywhere, everywhere, nullptr); }
    void set_close(float strip, float corner, const WeightCells* cells) const {
        std::atomic_ref(cells_).store(cells, std::memory_order_relaxed);
        std::atomic_ref(corner_).store(corner, std::memory_order_relaxed);
        std::atomic_ref(strip_).store(strip, std::memory_order_release);
    }

private:
    bool is_inside(const Vec2& w) const { return std::min({w.x, w.y, 1.0 - w.x - w.y}) >= margin_; }
    Vec3 at_edge(double u, double v, const Edges& edges) const;

    // A scene has millions of these, so data of the mesh is not duplicated.
    Vec3 vertex_, normal_;
    Vec3 dual1_, dual2_;  // weights of a point x: dot(x − vertex, dual)
    double error_;
    mutable const WeightCells* cells_ = nullptr;
    float rounding_;  // of Embree's hits, as a barycentric weight; 1 if the triangle is too thin to have a hit in double
    // Hits keep this barycentric distance from the edges, so that doubles resolve on which side of an adjacent wall
    // they are; 0 if the triangle is too thin for that.
    float margin_;
    static constexpr float everywhere = 1.0f, unknown = 2.0f;  // larger than any smallest barycentric weight
    mutable float strip_ = unknown, corner_ = 0.0f;
};

}  // namespace neumann
