// Proves which surfaces cannot see or occlude each other, from half-spaces that contain all surfaces; no ray is cast.
// If a scene is too large or no proof applies, the answers are "not known" (false).
//
// A surface that rises above a plane by up to 2^-32 of the scene's radius counts as lying in it. This is far more than
// the rounding error of coordinates in double, and a thousandth of the offset at which float rays start from a surface,
// so no ray can tell the difference.
#pragma once

#include "core/geometry/geometry.h"

namespace neumann {

struct ConvexBody {
    // All surfaces lie on the boundary of one convex body. Two points that are not in one of its planes then see each other,
    // because the segment between them lies inside the body.
    bool found = false;
    bool fronts_face_inwards = false;  // whether the fronts of all surfaces do
    bool is_closed = false;            // surfaces are seen in all directions from inside, unless some overlap
};

// Keeps a reference to the geometry.
class HalfSpaces {
public:
    explicit HalfSpaces(const Geometry& geometry);

    ConvexBody convex_body() const;
    // Whether no surface rises above the horizon of any point on this side of a shape, so that rays that leave it hit nothing.
    bool no_surface_seen_from(std::uint32_t shape, bool front) const;

private:
    // Whether all surfaces lie in the half-space n·(x − p) ≤ 0.
    bool end_at(const Vec3& p, const Vec3& n) const;
    // Whether all surfaces are within the ball, or within the infinite cylinder.
    bool are_within(const Sphere& ball) const;
    bool are_within(const Cylinder& cylinder) const;
    template <class Round, class Distance, class Reach>
    bool all_others(const Round& round, const Distance& distance, const Reach& reach) const;
    // Whether f(point, normal) is true for all planes of a shape.
    template <class F>
    bool all_planes(std::uint32_t shape, const F& f) const;
    double solid_angle_from_inside() const;

    const Geometry& geometry_;
    const std::vector<Shape>& shapes_;
    bool are_too_many_ = false;
    double rounding_;  // points this close to a plane count as on it
};

}  // namespace neumann
