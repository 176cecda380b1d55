// Beckmann's distribution of microfacet normals, that of a Gaussian surface whose slopes have the root mean square α > 0, one for
// both tangents or one for each, in the local frame. Smith's masking is exact, with erf; programs that approximate it by a rational
// function (Walter et al. 2007) differ by up to 0.35%.
#pragma once

#include "core/sampling/warp.h"

namespace neumann {

class Beckmann {
public:
    explicit Beckmann(double alpha) : Beckmann(Vec2(alpha)) {}
    // α along x and along y.
    explicit Beckmann(const Vec2& alpha) : alpha_(alpha), product_(alpha.x * alpha.y), ratio_(alpha.y / alpha.x) {}

    // D(m), as for Ggx.
    double density(const Vec3& m) const {
        if (m.z <= 0.0) return 0.0;
        const double z2 = m.z * m.z;
        const double slopes = std::exp(-(m.x * m.x * ratio_ + m.y * m.y / ratio_) / (product_ * z2));
        return slopes == 0.0 ? 0.0 : slopes * inv_pi / (product_ * z2 * z2);
    }
    double projected_area(const Vec3& v) const {
        const double x = alpha_.x * v.x, y = alpha_.y * v.y, spread = std::sqrt(x * x + y * y), a = v.z / spread;
        constexpr double half_inv_sqrt_pi = 0.28209479177387814347;
        return 0.5 * v.z * (1.0 + std::erf(a)) + half_inv_sqrt_pi * spread * std::exp(-a * a);
    }
    // Samples visible normals: Heitz and d'Eon, Importance Sampling Microfacet-Based BSDFs using the Distribution of
    // Visible Normals, 2014.
    Vec3 sample_visible(const Vec3& v, const Vec2& u) const;
    const Vec2& alpha() const { return alpha_; }

private:
    Vec2 alpha_;
    double product_, ratio_;
};

}  // namespace neumann
