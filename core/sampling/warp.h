// Maps from the unit square to directions and areas. The maps use no library function but the square root, so they give the same
// bits on every machine; the inverse maps need atan2.
#pragma once

#include "core/base/vec.h"

#include <algorithm>
#include <cmath>

namespace neumann {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double inv_pi = 0.31830988618379067154;

// sin φ and cos φ for |φ| ≤ π/4, by Taylor's polynomials in φ² (Estrin's scheme); truncation below 4e-13.
inline void sin_cos_quarter(double phi, double& sine, double& cosine) {
    const double x = phi * phi, x2 = x * x, x4 = x2 * x2;
    sine = phi * ((1.0 - x * (1.0 / 6)) + x2 * (1.0 / 120 - x * (1.0 / 5040)) +
                  x4 * ((1.0 / 362880 - x * (1.0 / 39916800)) + x2 * (1.0 / 6227020800.0)));
    cosine =
        (1.0 - x * 0.5) + x2 * (1.0 / 24 - x * (1.0 / 720)) + x4 * ((1.0 / 40320 - x * (1.0 / 3628800)) + x2 * (1.0 / 479001600.0));
}

// (cos, sin) of 2πu, u ∈ [0, 1), without branches, which would be mispredicted every other time.
inline Vec2 direction_on_circle(double u) {
    const int quadrant = static_cast<int>(4.0 * u + 0.5);
    double sin_cos[2];
    sin_cos_quarter((4.0 * u - quadrant) * (pi / 2.0), sin_cos[0], sin_cos[1]);
    constexpr double sign[5] = {1.0, 1.0, -1.0, -1.0, 1.0};
    const int odd = quadrant & 1;
    return {sign[quadrant + odd] * sin_cos[1 - odd], sign[quadrant] * sin_cos[odd]};
}

// The u of a direction (x, y), the inverse of direction_on_circle(), as exact as atan2.
inline double part_of_circle(double x, double y) {
    const double u = std::atan2(y, x) * (0.5 * inv_pi);
    return u < 0.0 ? u + 1.0 : u;
}

// A uniform point of the unit disc, by mapping concentric squares to circles: Shirley and Chiu, A Low Distortion Map
// Between Disk and Square, 1997.
inline Vec2 uniform_disk(const Vec2& u) {
    const double a = 2.0 * u.x - 1.0, b = 2.0 * u.y - 1.0;
    const bool flat = std::abs(a) > std::abs(b);
    const double radius = flat ? a : b, other = flat ? b : a, divisor = radius == 0.0 ? 1.0 : radius;
    double sine, cosine;
    sin_cos_quarter(other / divisor * (pi / 4.0), sine, cosine);
    return {(flat ? cosine : sine) * radius, (flat ? sine : cosine) * radius};
}

// The inverse of uniform_disk, for points of the unit disc.
inline Vec2 square_of_disk(const Vec2& p) {
    const bool flat = std::abs(p.x) > std::abs(p.y);
    const double along = flat ? p.x : p.y, across = flat ? p.y : p.x;
    if (along == 0.0) return Vec2(0.5);
    const double radius = std::copysign(std::sqrt(p.x * p.x + p.y * p.y), along);
    const double other = radius * std::atan(across / along) * (4.0 * inv_pi);
    return (flat ? Vec2(radius, other) : Vec2(other, radius)) * 0.5 + 0.5;
}

// The pdf is cosθ/π per solid angle, about +z: Malley's disc. cosθ > 0 for 0 < u < 1.
inline Vec3 cosine_hemisphere(const Vec2& u) {
    const double radius = std::max(std::abs(2.0 * u.x - 1.0), std::abs(2.0 * u.y - 1.0));
    return Vec3(uniform_disk(u), std::sqrt(1.0 - radius * radius));
}

// The pdf is 1/(2π) per solid angle, about +z: Archimedes' z, uniform.
inline Vec3 uniform_hemisphere(const Vec2& u) { return Vec3(direction_on_circle(u.y) * std::sqrt(u.x * (2.0 - u.x)), 1.0 - u.x); }

// The pdf is 1/(2π (1 − cosα)) per solid angle, within the angle α of +z.
inline Vec3 uniform_cone(const Vec2& u, double cos_alpha) {
    const double z = 1.0 - u.x * (1.0 - cos_alpha);
    return Vec3(direction_on_circle(u.y) * std::sqrt((1.0 - z) * (1.0 + z)), z);
}

// The pdf is 1/(4π) per solid angle.
inline Vec3 uniform_sphere(const Vec2& u) {
    return Vec3(direction_on_circle(u.y) * (2.0 * std::sqrt(u.x * (1.0 - u.x))), 1.0 - 2.0 * u.x);
}

// Barycentric weights of the second and third vertex, uniform by area: Heitz, A Low-Distortion Map Between Triangle and Square,
// 2019.
inline Vec2 uniform_triangle(const Vec2& u) {
    const double x = 0.5 * u.x, y = 0.5 * u.y, fold = y - x;
    return {x + std::max(-fold, 0.0), y + std::max(fold, 0.0)};
}

}  // namespace neumann
