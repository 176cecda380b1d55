// Maps from the unit square to directions and areas. The maps use no library functions but the square root, so they give the same
// bits on every machine.
#pragma once

#include "core/base/vec.h"

#include <cmath>

namespace neumann {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double inv_pi = 0.31830988618379067154;

// sin φ and cos φ for |φ| ≤ π/4, by Taylor's polynomials: truncation below 1e-16.
inline void sin_cos_quarter(double phi, double& sine, double& cosine) {
    const double x = phi * phi;
    sine = phi * (1.0 + x * (-1.0 / 6 + x * (1.0 / 120 + x * (-1.0 / 5040 + x * (1.0 / 362880 + x * (-1.0 / 39916800 +
                 x * (1.0 / 6227020800.0 + x * (-1.0 / 1307674368000.0))))))));
    cosine = 1.0 + x * (-0.5 + x * (1.0 / 24 + x * (-1.0 / 720 + x * (1.0 / 40320 + x * (-1.0 / 3628800 +
             x * (1.0 / 479001600.0 + x * (-1.0 / 87178291200.0 + x * (1.0 / 20922789888000.0))))))));
}

// Uniform on the unit disc: Shirley and Chiu's concentric map (1997).
inline Vec2 concentric_disk(const Vec2& u) {
    const double a = 2.0 * u.x - 1.0, b = 2.0 * u.y - 1.0;
    if (a == 0.0 && b == 0.0) return Vec2(0.0);
    const bool wide = std::abs(a) > std::abs(b);
    const double r = wide ? a : b;
    double sine, cosine;
    sin_cos_quarter(pi / 4.0 * (wide ? b / a : a / b), sine, cosine);
    return wide ? Vec2(r * cosine, r * sine) : Vec2(r * sine, r * cosine);
}

// pdf cosθ/π per solid angle, about +z (Malley's method). cosθ > 0.
inline Vec3 cosine_hemisphere(const Vec2& u) {
    const Vec2 d = concentric_disk(u);
    const double r2 = d.x * d.x + d.y * d.y;
    return {d.x, d.y, std::sqrt(std::max(1.0 - r2, 1e-18))};
}

// pdf 1/(2π) per solid angle, about +z. Area-preserving from the disc: z = 1 − r².
inline Vec3 uniform_hemisphere(const Vec2& u) {
    const Vec2 d = concentric_disk(u);
    const double r2 = d.x * d.x + d.y * d.y;
    return Vec3(d * std::sqrt(2.0 - r2), 1.0 - r2);
}

// pdf 1/(4π) per solid angle.
inline Vec3 uniform_sphere(const Vec2& u) {
    const bool upper = u.x < 0.5;
    const Vec3 w = uniform_hemisphere({upper ? 2.0 * u.x : 2.0 * u.x - 1.0, u.y});
    return upper ? w : -w;
}

// Barycentric weights of the second and third vertex, uniform by area.
inline Vec2 uniform_triangle(const Vec2& u) {
    const double root = std::sqrt(u.x);
    return {root * (1.0 - u.y), root * u.y};
}

}  // namespace neumann
