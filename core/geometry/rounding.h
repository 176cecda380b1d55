// Bounds on how far rounding to float (in Embree) and to double moves a point.
#pragma once

#include "core/base/vec.h"

#include <algorithm>
#include <cmath>

namespace neumann {

inline double largest_component(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

// A bound on float rounding in a scene of about unit size. It covers the ends and direction of a ray from anywhere in the scene,
// and Embree's distance along the normal of a triangle of this size, which Embree computes from vertices relative to the ray's
// origin. 2⁻²⁴ is half the spacing of floats at 1.
inline double float_rounding(double size) { return 0x1p-24 * 8.0 * (1.0 + size); }

// A bound on the error of a distance computed from p and from coordinates up to `size`: 8 units in the last place.
inline double double_rounding(const Vec3& p, double size) { return 0x1p-49 * (largest_component(p) + size); }

}  // namespace neumann
