// What surfaces can see of each other, proven from the half-spaces that hold them all; no ray is cast. Where a scene is not
// covered, or too large to be looked through, the answer is that nothing is known.
//
// A surface may rise above a plane by 2^-32 of the scene's radius and still count as on it: far more than coordinates in double are
// rounded by, and a thousandth of the distance at which rays in float start clear of a surface, so no ray could tell.
#pragma once

#include "core/geometry/geometry.h"

namespace neumann {

struct ConvexBody {
    // All surfaces lie on the boundary of one convex body: two points that are not in one plane of it see each other, for what is
    // between them lies inside of it.
    bool found = false;
    bool fronts_face_inwards = false;  // all of them
    bool is_closed = false;            // from inside, surfaces are seen in all directions, unless some lie on others
};

// Refers to the geometry.
class HalfSpaces {
public:
    explicit HalfSpaces(const Geometry& geometry);

    ConvexBody convex_body() const;
    // No surface rises above the horizon of any point on this side of a shape: rays that leave it meet nothing.
    bool no_surface_seen_from(std::uint32_t shape, bool front) const;

private:
    // No surface is farther along n than p.
    bool end_at(const Vec3& p, const Vec3& n) const;
    // All surfaces are within the ball, or within the cylinder drawn out without end.
    bool are_within(const Sphere& ball) const;
    bool are_within(const Cylinder& cylinder) const;
    template <class Round, class Distance, class Reach>
    bool all_others(const Round& round, const Distance& distance, const Reach& reach) const;
    // f(a point of it, its normal) says yes for all planes of a shape.
    template <class F>
    bool all_planes(std::uint32_t shape, const F& f) const;
    double solid_angle_from_inside() const;

    const Geometry& geometry_;
    const std::vector<Shape>& shapes_;
    bool are_too_many_ = false;
    double rounding_;  // what is on a plane for all that rays can tell
};

}  // namespace neumann
