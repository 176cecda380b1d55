// The projected solid angle of a polygon at a point of a surface, ∫ cosθ dω over what is above the horizon, and directions in
// proportion to cosθ. On the unit disk, where cosθ dω is area, a polygon's edges are arcs of ellipses around the center: Lambert,
// Photometria, 1760. Sectors are those of Peters, BRDF Importance Sampling for Polygonal Lights, 2021.
#pragma once

#include "core/base/frame.h"
#include "core/base/vec.h"

#include <algorithm>
#include <array>
#include <span>

namespace neumann {

class ProjectedPolygon {
public:
    // A convex polygon of 3 or 4 corners, seen from the origin, where a surface has this normal. Its plane must miss the origin by
    // more than rounding: from its own plane the polygon covers nothing or half of the sky, as its corners happen to be rounded.
    ProjectedPolygon(std::span<const Vec3> corners, const Vec3& normal);

    // The projected solid angle, at most π; 0 if the polygon is below the horizon. The absolute error is about 10⁻¹⁵.
    double area() const { return area_; }
    // Samples a direction of unit length; area() must be positive.
    Vec3 sample(const Vec2& u) const;
    // The density of a direction in the polygon, per solid angle: cosθ / area().
    double pdf(const Vec3& w) const { return std::max(glm::dot(frame_.n, w), 0.0) / area_; }

private:
    // An edge on the disk, between two directions from its center: the great circle with the unit normal (m √(1 − z²), ±z).
    struct Edge {
        Vec2 from, to, m;
        double z;
        // 1 − r², which is cos²θ, where the ellipse has the direction d.
        double height2(const Vec2& d) const;
        // The area between the center and the arc from a to b.
        double sector(const Vec2& a, const Vec2& b) const;
        // b such that sector(a, b) = area.
        Vec2 end_of_sector(const Vec2& a, double area) const;
    };
    struct Edges {
        static constexpr std::size_t most = 8;  // each side of a quadrilateral leaves at most two corners above the horizon
        std::array<Edge, most> edge;
        std::size_t count = 0;
        void add(const Edge& e) { edge[count++] = e; }
    };
    static Vec2 end_between(const Edge& outer, const Edge& inner, const Vec2& a, const Vec2& b, double share, double area);

    Frame frame_;
    Edges outer_, inner_;  // both counterclockwise around the center
    double area_ = 0.0;
};

}  // namespace neumann
