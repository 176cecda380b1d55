// Phong's glossy lobe around the mirror direction M ωo, as normalised by Lafortune and Willems, Using the Modified Phong
// Reflectance Model for Physically Based Rendering, 1994 (`phong` of Mitsuba 0.6):
//
//     g(ωi, ωo) = (n + 2)/(2π) cosⁿα,   α the angle between ωi and M ωo, below π/2.
//
// ∫ g cosθ dω is 1 at normal incidence. It is the convolution of two functions that fall with the angle, so it is smaller at all
// other angles, where part of the lobe lies below the horizon.
#pragma once

#include "core/base/frame.h"
#include "core/material/diffuse_and_glossy.h"

#include <cmath>

namespace neumann {

class PhongLobe {
public:
    // `exponent` is n ≥ 0, equal in all channels.
    explicit PhongLobe(SurfaceFunction exponent) : exponent_(std::move(exponent)) {}

    double eval(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const {
        const double n = exponent_(p).r;
        return (n + 2.0) * (0.5 * inv_pi) * power(wo, wi, n);
    }
    double pdf(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const {
        const double n = exponent_(p).r;
        return (n + 1.0) * (0.5 * inv_pi) * power(wo, wi, n);
    }
    Vec3 sample(const ShadingPoint& p, const Vec3& wo, const Vec2& u) const {
        const double log_cosine = std::log1p(-u.x) / (exponent_(p).r + 1.0);
        const Vec2 around = direction_on_circle(u.y) * std::sqrt(-std::expm1(2.0 * log_cosine));
        return Frame(mirrored(wo)).to_world({around.x, around.y, std::exp(log_cosine)});
    }
    double largest_albedo() const { return 1.0; }
    bool is_constant() const { return exponent_.is_constant(); }
    bool is_isotropic() const { return true; }
    // The α of the Beckmann facets whose reflections spread as far: a variance of 2 α² against 1/n.
    double alpha() const { return 1.0 / std::sqrt(1.0 + 2.0 * exponent_.upper_bound().r); }

private:
    static Vec3 mirrored(const Vec3& w) { return {-w.x, -w.y, w.z}; }
    static double power(const Vec3& wo, const Vec3& wi, double n) {
        const double cosine = glm::dot(mirrored(wo), wi);
        return cosine > 0.0 ? std::pow(std::min(cosine, 1.0), n) : 0.0;
    }

    SurfaceFunction exponent_;
};

using Phong = DiffuseAndGlossy<PhongLobe>;

}  // namespace neumann
