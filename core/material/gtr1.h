// The microfacet distribution of a clear coat, whose highlight has long tails: Burley, Physically Based Shading at Disney, 2012,
// appendix B.2, with 0 < α < 1.
#pragma once

#include "core/sampling/warp.h"

#include <algorithm>

namespace neumann {

class Gtr1 {
public:
    explicit Gtr1(double alpha) : a2_(alpha * alpha), log_a2_(std::log(a2_)) {}

    // D(m), with ∫ D(m) m.z dm = 1.
    double density(const Vec3& m) const {
        const double sin2 = m.x * m.x + m.y * m.y;
        return (a2_ - 1.0) * inv_pi / (log_a2_ * (sin2 + a2_ * m.z * m.z));
    }
    // Samples a normal with the pdf D(m) m.z, per solid angle.
    Vec3 sample(const Vec2& u) const {
        const double cos2 = (1.0 - std::exp(log_a2_ * (1.0 - u.y))) / (1.0 - a2_);
        return Vec3(direction_on_circle(u.x) * std::sqrt(std::max(1.0 - cos2, 0.0)), std::sqrt(cos2));
    }

private:
    double a2_, log_a2_;
};

}  // namespace neumann
