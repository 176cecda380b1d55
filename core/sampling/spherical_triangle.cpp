#include "core/sampling/spherical_triangle.h"

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

// The unit tangent at a of the great circle from a to b.
Vec3 tangent(const Vec3& a, const Vec3& b) { return glm::normalize(b - a * glm::dot(a, b)); }

}  // namespace

double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double volume = std::abs(glm::dot(a, glm::cross(b, c)));
    const double denominator = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    return 2.0 * std::atan2(volume, denominator);
}

Vec3 sample_spherical_triangle(const Vec3& a, const Vec3& b, const Vec3& c, double solid_angle, const Vec2& u) {
    const Vec3 A = glm::normalize(a), B = glm::normalize(b), C = glm::normalize(c);
    // The angle at A, and the fraction of the area that the great circle from B to a point of the side AC cuts off.
    const Vec3 to_b = tangent(A, B), to_c = tangent(A, C);
    const double cos_alpha = std::clamp(glm::dot(to_b, to_c), -1.0, 1.0), sin_alpha = std::sqrt(1.0 - cos_alpha * cos_alpha),
                 alpha = std::atan2(glm::length(glm::cross(to_b, to_c)), glm::dot(to_b, to_c));
    const double cos_side = glm::dot(A, B), part = u.x * solid_angle - alpha, s = std::sin(part), t = std::cos(part),
                 p = t - cos_alpha, r = s + sin_alpha * cos_side, denominator = (r * s + p * t) * sin_alpha;
    const double q = denominator != 0.0 ? std::clamp(((r * t - p * s) * cos_alpha - r) / denominator, -1.0, 1.0) : 1.0;
    const Vec3 on_side = A * q + to_c * std::sqrt(1.0 - q * q);
    // The sample is a point between that one and B.
    const double z = 1.0 - u.y * (1.0 - glm::dot(on_side, B));
    return B * z + tangent(B, on_side) * std::sqrt(std::max(1.0 - z * z, 0.0));
}

}  // namespace neumann
