// A smooth dielectric layer over a diffuse base (Mitsuba's `plastic`). One-sided. With η the refractive index of the layer relative
// to the outside, F Fresnel's share and F̄ its mean inside the layer, over all directions,
//
//     fs(ωi → ωo) |cos θi| = s F(cos θi) δ(ωi − M ωo) + b (1 − F(cos θi)) (1 − F(cos θo)) cos θi / π,
//     b = ρ / (η² (1 − ρ F̄)),   or ρ / (η² (1 − F̄)) without the colour shift (`nonlinear` is false).
//
// F̄ is Mitsuba's fit: the albedo over a white base is up to 1.0012 for η ≤ 2 and 1.03 for 2.4; largest_albedo() accounts for it.
#pragma once

#include "core/material/bsdf_sample.h"
#include "core/material/diffuse_fresnel.h"
#include "core/material/fresnel.h"
#include "core/material/lobe.h"
#include "core/material/surface_function.h"
#include "core/sampling/choose.h"
#include "core/sampling/warp.h"

namespace neumann {

// Computes b, and the probability of sampling the boundary.
class CoatedBase {
public:
    // `internal`: F̄. `specular` only affects the probability of sampling the boundary.
    CoatedBase(double eta, double internal, SurfaceFunction diffuse, const SurfaceFunction& specular, bool nonlinear)
        : inv_eta2_(1.0 / (eta * eta)), internal_(internal), nonlinear_(nonlinear), diffuse_(std::move(diffuse)) {
        const double s = mean_component(specular.upper_bound()), d = mean_component(diffuse_.upper_bound());
        specular_share_ = s + d > 0.0 ? s / (s + d) : 1.0;
    }

    Rgb operator()(const ShadingPoint& p) const { return of(diffuse_(p), internal_); }
    Rgb upper_bound() const { return upper_bound(internal_); }
    // b for another F̄.
    Rgb operator()(const ShadingPoint& p, double internal) const { return of(diffuse_(p), internal); }
    Rgb upper_bound(double internal) const { return of(diffuse_.upper_bound(), internal); }
    // The probability of sampling the boundary if it reflects F.
    double specular_probability(double F) const {
        const double s = F * specular_share_, d = (1.0 - F) * (1.0 - specular_share_);
        return s + d > 0.0 ? s / (s + d) : 1.0;
    }
    bool is_constant() const { return diffuse_.is_constant(); }
    bool is_grey() const { return diffuse_.is_grey(); }

private:
    Rgb of(const Rgb& rho, double internal) const { return rho * inv_eta2_ / (1.0 - internal * (nonlinear_ ? rho : Rgb(1.0))); }

    double inv_eta2_, internal_, specular_share_;
    bool nonlinear_;
    SurfaceFunction diffuse_;
};

class Plastic {
public:
    Plastic(double eta, SurfaceFunction diffuse_reflectance, SurfaceFunction specular_reflectance, bool nonlinear)
        : eta_(eta),
          base_(eta, fitted_diffuse_fresnel(1.0 / eta), std::move(diffuse_reflectance), specular_reflectance, nonlinear),
          specular_(std::move(specular_reflectance)) {}

    Rgb eval(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const {
        if (wo.z <= 0.0 || wi.z <= 0.0) return Rgb(0.0);
        return base_(p) * ((1.0 - fresnel(wo.z)) * (1.0 - fresnel(wi.z)) * inv_pi);
    }
    double pdf(const ShadingPoint&, const Vec3& wo, const Vec3& wi) const {
        if (wo.z <= 0.0 || wi.z <= 0.0) return 0.0;
        return (1.0 - base_.specular_probability(fresnel(wo.z))) * wi.z * inv_pi;
    }
    BsdfSample sample(const ShadingPoint& p, const Vec3& wo, Vec2 u) const {
        if (wo.z <= 0.0) return {};
        const double F = fresnel(wo.z), probability = base_.specular_probability(F);
        if (choose_first(probability, u.x)) return {Vec3(-wo.x, -wo.y, wo.z), specular_(p) * (F / probability), delta_pdf};
        const Vec3 wi = cosine_hemisphere(u);
        const double rest = 1.0 - probability;
        return {wi, base_(p) * ((1.0 - F) * (1.0 - fresnel(wi.z)) / rest), rest * wi.z * inv_pi};
    }
    Rgb reflectance(const ShadingPoint&) const { return Rgb(1.0); }
    const Plastic& white() const { return *this; }
    // s F + b (1 − F) (1 − F̄) is linear in F, so its maximum is at the smallest F or at F = 1.
    Rgb largest_albedo() const {
        const double F = fresnel(1.0);
        const Rgb s = specular_.upper_bound(), d = base_.upper_bound() * (1.0 - diffuse_fresnel(eta_));
        return glm::max(s, s * F + d * (1.0 - F));
    }
    bool is_constant() const { return base_.is_constant() && specular_.is_constant(); }
    bool is_grey() const { return base_.is_grey() && specular_.is_grey(); }
    Lobe lobe() const { return {Lobe::Kind::specular, 0.0}; }

private:
    double fresnel(double cosine) const { return conductor_fresnel(cosine, eta_, 0.0); }

    double eta_;
    CoatedBase base_;
    SurfaceFunction specular_;
};

}  // namespace neumann
