// Triangles as they are seen from a point: their solid angle, and directions uniform in it.
#pragma once

#include "core/base/vec.h"

namespace neumann {

// Of the triangle with these corners, seen from the origin: van Oosterom and Strackee, The Solid Angle of a Plane Triangle, 1983.
// At least 0; relative error about 10⁻¹⁵ over the solid angle.
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c);

// A direction to the triangle, pdf 1/solid angle: Arvo, Stratified Sampling of Spherical Triangles, 1995. `solid_angle` > 0.
Vec3 sample_spherical_triangle(const Vec3& a, const Vec3& b, const Vec3& c, double solid_angle, const Vec2& u);

}  // namespace neumann
