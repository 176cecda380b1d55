// Solid angle and uniform sampling of a triangle seen from a point.
#pragma once

#include "core/base/vec.h"

namespace neumann {

// The solid angle of the triangle with these corners, seen from the origin: van Oosterom and Strackee, The Solid Angle of a Plane
// Triangle, 1983. It is at least 0; the relative error is about 10⁻¹⁵ divided by the solid angle.
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c);

// Samples a direction to the triangle with pdf 1/solid_angle, per solid angle: Arvo, Stratified Sampling of Spherical Triangles,
// 1995. `solid_angle` > 0.
Vec3 sample_spherical_triangle(const Vec3& a, const Vec3& b, const Vec3& c, double solid_angle, const Vec2& u);

}  // namespace neumann
