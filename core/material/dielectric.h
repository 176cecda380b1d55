// A smooth boundary between two transparent media, seen from one of them (Mitsuba's `dielectric`); the other side is another
// Dielectric, with 1/η. With η the refractive index beyond the boundary over that on this side and F Fresnel's share,
//
//     fs(ωi → ωo) |cos θi| = R F(cos θo) δ(ωi − M ωo) + T (1 − F(cos θo)) / η² δ(ωi − S ωo),
//
// M ωo the mirror image and S ωo the direction of Snell's law, below the surface; R and T are factors, 1 in nature. Radiance
// changes by 1/η² because a cone of light becomes wider or narrower; L/n² is conserved (Veach 1997, 5.2), and fs is reciprocal up
// to that factor: fs(ωi → ωo)/no² = fs(ωo → ωi)/ni².
#pragma once

#include "core/material/bsdf_sample.h"
#include "core/material/fresnel.h"
#include "core/material/lobe.h"
#include "core/material/surface_function.h"

namespace neumann {

class Dielectric {
public:
    explicit Dielectric(double eta, SurfaceFunction specular_reflectance = Rgb(1.0),
                        SurfaceFunction specular_transmittance = Rgb(1.0))
        : eta_(eta), reflectance_(std::move(specular_reflectance)), transmittance_(std::move(specular_transmittance)) {}

    Rgb eval(const ShadingPoint&, const Vec3&, const Vec3&) const { return Rgb(0.0); }
    double pdf(const ShadingPoint&, const Vec3&, const Vec3&) const { return 0.0; }
    // Light is reflected with the probability F, which is 1 beyond the critical angle.
    BsdfSample sample(const ShadingPoint& p, const Vec3& wo, const Vec2& u) const {
        if (wo.z <= 0.0) return {};
        if (u.x < choice(wo)) return {Vec3(-wo.x, -wo.y, wo.z), reflectance_(p), delta_pdf};
        const double cosine = std::sqrt((eta_ - 1.0) * (eta_ + 1.0) + wo.z * wo.z);
        return {Vec3(-wo.x, -wo.y, -cosine) / eta_, transmittance_(p) / (eta_ * eta_), delta_pdf, eta_};
    }
    double choice(const Vec3& wo) const { return conductor_fresnel(wo.z, eta_, 0.0); }
    Rgb reflectance(const ShadingPoint&) const { return Rgb(1.0); }
    const Dielectric& white() const { return *this; }
    Rgb largest_albedo() const { return glm::max(reflectance_.upper_bound(), transmittance_.upper_bound() / (eta_ * eta_)); }
    Rgb largest_basic_albedo() const { return glm::max(reflectance_.upper_bound(), transmittance_.upper_bound()); }
    bool transmits() const { return true; }
    double refractive_ratio() const { return eta_; }
    bool is_constant() const { return reflectance_.is_constant() && transmittance_.is_constant(); }
    bool is_grey() const { return reflectance_.is_grey() && transmittance_.is_grey(); }
    Lobe lobe() const { return {Lobe::Kind::specular, 0.0}; }

private:
    double eta_;
    SurfaceFunction reflectance_, transmittance_;
};

}  // namespace neumann
