// Vectors and colours. Points are in scene units, directions have unit length, Rgb is linear and carries the unit of
// what it describes (radiance: W·m⁻²·sr⁻¹, reflectance: 1).
#pragma once

#include <cmath>

#include <glm/glm.hpp>

namespace neumann {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Mat4 = glm::dmat4;

using Rgb = glm::dvec3;

inline double max_component(const Rgb& c) { return c.r > c.g ? (c.r > c.b ? c.r : c.b) : (c.g > c.b ? c.g : c.b); }
inline double mean_component(const Rgb& c) { return (c.r + c.g + c.b) / 3.0; }
inline bool is_grey(const Rgb& c) { return c.r == c.g && c.g == c.b; }
inline bool is_black(const Rgb& c) { return c.r == 0.0 && c.g == 0.0 && c.b == 0.0; }
inline bool is_finite(const Rgb& c) { return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b); }

// |v|, accurate also if the squares of small components would vanish.
inline double length_of(const Vec3& v) {
    const double largest = max_component(glm::abs(v));
    return largest > 0.0 ? largest * glm::length(v / largest) : 0.0;
}

}  // namespace neumann
