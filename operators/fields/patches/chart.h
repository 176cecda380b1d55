// A piece of surface with coordinates (s, t) in [0, 1]², which is cut into patches.
#pragma once

#include "core/geometry/geometry.h"
#include "operators/fields/patches/face_clusters.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>

namespace neumann {

// A rectangle of coordinates.
struct Cell {
    double s0, s1, t0, t1;
};

// The bilinear map P(s, t) = a + s (b − a) + t (d − a) + s t (a − b + c − d) of a plane convex quadrilateral a b c d. Its Jacobian
// is linear in s and t, so areas and uniform points have closed forms.
class QuadMap {
public:
    // The corners are counter-clockwise about `normal`; c may coincide with d, but no three others lie on a line.
    QuadMap(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& normal);

    Vec3 position(const Vec2& st) const {
        const Vec2 p = e_ * st.x + f_ * st.y + g_ * (st.x * st.y);
        return a_ + x_ * p.x + y_ * p.y;
    }
    Vec2 coordinates(const Vec3& position) const {
        const Vec2 h(glm::dot(position - a_, x_), glm::dot(position - a_, y_));
        if (is_parallelogram_) return {cross(h, f_) * of_area_, cross(e_, h) * of_area_};
        const double k1 = j0_ + cross(h, g_), k0 = cross(h, e_);
        const double t = -2.0 * k0 / (k1 + std::sqrt(std::max(k1 * k1 - 4.0 * k0 * jt_, 0.0)));
        const Vec2 across = e_ + g_ * t;
        const double length2 = glm::dot(across, across);
        return {length2 > 0.0 ? glm::dot(h - f_ * t, across) / length2 : 0.5, t};
    }
    Vec3 normal() const { return glm::cross(x_, y_); }
    double area(const Cell& c) const {
        return (c.s1 - c.s0) * (c.t1 - c.t0) * (j0_ + 0.5 * (js_ * (c.s0 + c.s1) + jt_ * (c.t0 + c.t1)));
    }
    // A point that is uniform by area if u is uniform in [0, 1)².
    Vec2 uniform(const Cell& cell, const Vec2& u) const {
        if (is_parallelogram_) return {cell.s0 + (cell.s1 - cell.s0) * u.x, cell.t0 + (cell.t1 - cell.t0) * u.y};
        return uniform_in_trapezoids(cell, u);
    }
    // The lengths of the lines t = 1/2 and s = 1/2.
    Vec2 lengths() const { return {glm::length(e_ + 0.5 * g_), glm::length(f_ + 0.5 * g_)}; }

private:
    static double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }
    Vec2 uniform_in_trapezoids(const Cell& cell, const Vec2& u) const;

    Vec3 a_, x_, y_;       // an orthonormal basis of the plane
    Vec2 e_, f_, g_;       // b − a, d − a and a − b + c − d in this basis
    double j0_, js_, jt_;  // |∂P/∂s × ∂P/∂t| = j0 + js s + jt t
    double of_area_;       // 1 / j0
    bool is_parallelogram_;
};

class Chart {
public:
    // The chart of a sphere, a cylinder or a disc.
    Chart(const Geometry& geometry, std::uint32_t shape);
    // The chart of the quadrilateral a b c d, made of the triangles `lower`, on b's side of the diagonal a c, and
    // `upper`; they may be the same.
    Chart(std::uint32_t shape, const std::array<Vec3, 4>& corners, const Vec3& normal, std::uint32_t lower, std::uint32_t upper);

    // The chart of `faces` small faces of a mesh or an instance, which have this area. It has no clusters before set_clusters().
    Chart(std::uint32_t shape, std::size_t faces, double area);

    std::uint32_t shape() const { return shape_; }
    // Whether the chart is a quadrilateral, with corners (the last two may coincide) and a normal.
    bool is_plane() const { return quad_.has_value(); }
    const std::array<Vec3, 4>& corners() const { return corners_; }
    Vec3 normal() const { return quad_->normal(); }
    // The clusters, which are ranges of s; null if the chart has none.
    const FaceClusters* clusters() const { return clusters_.get(); }
    // The number of faces in clusters; 0 for other charts.
    std::size_t small_faces() const { return small_faces_; }
    void set_clusters(std::shared_ptr<const FaceClusters> clusters) { clusters_ = std::move(clusters); }

    // The coordinates of a position on the chart, or near its plane; not for clusters.
    Vec2 coordinates(const Geometry& geometry, const Vec3& position) const {
        return quad_ ? quad_->coordinates(position) : geometry.round_coordinates(shape_, position);
    }
    Vec2 coordinates(const Geometry& geometry, const SurfacePoint& p) const {
        return clusters_ ? clusters_->coordinates(geometry, p) : coordinates(geometry, p.position);
    }
    SurfacePoint point(const Geometry& geometry, const Vec2& st) const {
        SurfacePoint p = bare_point(geometry, st);
        if (clusters_) geometry.look_around(p);
        return p;
    }
    // On clusters, whose faces are many, the point is not checked for close faces, as Geometry::look_around() would.
    SurfacePoint bare_point(const Geometry& geometry, const Vec2& st) const {
        if (clusters_) return clusters_->bare_point(geometry, shape_, st);
        if (!quad_) return geometry.point(shape_, 0, st);
        const Vec3 p = quad_->position(st);
        return geometry.point_on_triangle(shape_, glm::dot(p - corners_[0], up_) > 0.0 ? upper_ : lower_, p);
    }
    double area(const Cell& cell) const { return quad_ ? quad_->area(cell) : area_ * (cell.s1 - cell.s0) * (cell.t1 - cell.t0); }
    Vec2 uniform(const Cell& cell, const Vec2& u) const {
        if (quad_) return quad_->uniform(cell, u);
        return {cell.s0 + (cell.s1 - cell.s0) * u.x, cell.t0 + (cell.t1 - cell.t0) * u.y};
    }
    // The approximate lengths of lines of constant t and of constant s.
    Vec2 lengths() const { return lengths_; }
    // Whether t = 0 and t = 1 are the same line.
    bool closed_in_t() const { return closed_in_t_; }

private:
    std::uint32_t shape_;
    std::optional<QuadMap> quad_;
    std::array<Vec3, 4> corners_{};
    Vec3 up_{0.0};  // points with (p − first corner) · up > 0 lie on `upper`
    std::uint32_t lower_ = 0, upper_ = 0;
    double area_ = 0.0;  // for round shapes and clusters
    Vec2 lengths_;
    bool closed_in_t_ = false;
    std::size_t small_faces_ = 0;
    std::shared_ptr<const FaceClusters> clusters_;
};

}  // namespace neumann
