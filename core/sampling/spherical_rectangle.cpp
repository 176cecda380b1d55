#include "core/sampling/spherical_rectangle.h"

#include "core/sampling/warp.h"

#include <algorithm>
#include <cmath>

namespace neumann {

SphericalRectangle::SphericalRectangle(const Vec3& corner, const Vec3& a, const Vec3& b)
    : x_(glm::normalize(a)), y_(glm::normalize(b)), z_(glm::cross(x_, y_)) {
    if (glm::dot(corner, z_) < 0.0) z_ = -z_;
    height_ = glm::dot(corner, z_);
    x0_ = glm::dot(corner, x_);
    y0_ = glm::dot(corner, y_);
    x1_ = x0_ + glm::length(a);
    y1_ = y0_ + glm::length(b);
    // The angle between the planes through the two sides at a corner, from its sine and cosine: the paper's arc cosine loses half
    // of the digits if the rectangle is seen at a flat angle.
    const auto angle = [&](double x, double y, double sign) {
        return std::atan2(height_ * std::sqrt(x * x + y * y + height_ * height_), sign * x * y);
    };
    first_ = 2.0 * pi - angle(x0_, y1_, 1.0) - angle(x0_, y0_, -1.0);
    solid_angle_ = std::max(angle(x1_, y0_, 1.0) + angle(x1_, y1_, -1.0) - first_, 0.0);
}

Vec3 SphericalRectangle::sample(const Vec2& u) const {
    // Choose x such that the part from x0 to x has the fraction u.x of the solid angle: the paper's equation with
    // b0² − 1 = −h² / (h² + y0²).
    const double h2 = height_ * height_, b0 = y0_ / std::sqrt(h2 + y0_ * y0_), b1 = y1_ / std::sqrt(h2 + y1_ * y1_);
    const double part = first_ + u.x * solid_angle_, f = -(std::cos(part) * b0 + b1) / std::sin(part);
    const double square = f * f - h2 / (h2 + y0_ * y0_);
    const double x =
        std::clamp(square > 0.0 ? std::copysign(height_ / std::sqrt(square), f) : std::copysign(x1_ - x0_, f), x0_, x1_);
    // Choose y uniformly in the sine of the elevation.
    const double d2 = x * x + h2, s0 = y0_ / std::sqrt(d2 + y0_ * y0_), s1 = y1_ / std::sqrt(d2 + y1_ * y1_);
    const double s = s0 + u.y * (s1 - s0), cos2 = (1.0 - s) * (1.0 + s);
    const double y = cos2 > 0.0 ? std::clamp(s * std::sqrt(d2 / cos2), y0_, y1_) : y1_;
    return x_ * x + y_ * y + z_ * height_;
}

}  // namespace neumann
