// How far rounding moves a point: to float, as Embree sees it, and to double.
#pragma once

#include "core/base/vec.h"

#include <algorithm>
#include <cmath>

namespace neumann {

inline double largest_component(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

// The distance that clears rounding to float, in a scene of about unit size: of the ends and the direction of a ray, which may come
// from anywhere in the scene, and of Embree's distance along the normal of a triangle of this size, which is computed from its
// vertices relative to the origin. 2⁻²⁴ is half the spacing of floats at 1.
inline double float_rounding(double size) { return 0x1p-24 * 8.0 * (1.0 + size); }

// By how much a distance computed from p and from coordinates up to `size` may be wrong: 8 units of the last place.
inline double double_rounding(const Vec3& p, double size) { return 0x1p-49 * (largest_component(p) + size); }

}  // namespace neumann
