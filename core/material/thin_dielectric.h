// A pane so thin that light goes straight through it (Mitsuba's `thindielectric`), the same from both sides. Internal reflections
// are added up: with F the Fresnel reflectance of one boundary,
//
//     F + (1 − F)² F (1 + F² + F⁴ + …) = 2F / (1 + F)
//
// is reflected, and the rest, (1 − F)/(1 + F), is transmitted. All of this is one bounce.
#pragma once

#include "core/material/bsdf_sample.h"
#include "core/material/fresnel.h"
#include "core/material/lobe.h"
#include "core/material/surface_function.h"

namespace neumann {

class ThinDielectric {
public:
    // `eta`: the refractive index of the pane divided by that around it.
    explicit ThinDielectric(double eta, SurfaceFunction specular_reflectance = Rgb(1.0),
                            SurfaceFunction specular_transmittance = Rgb(1.0))
        : eta_(eta), reflectance_(std::move(specular_reflectance)), transmittance_(std::move(specular_transmittance)) {}

    Rgb eval(const ShadingPoint&, const Vec3&, const Vec3&) const { return Rgb(0.0); }
    double pdf(const ShadingPoint&, const Vec3&, const Vec3&) const { return 0.0; }
    BsdfSample sample(const ShadingPoint& p, const Vec3& wo, const Vec2& u) const {
        if (wo.z <= 0.0) return {};
        if (u.x < choice(wo)) return {Vec3(-wo.x, -wo.y, wo.z), reflectance_(p), delta_pdf};
        return {-wo, transmittance_(p), delta_pdf};
    }
    double choice(const Vec3& wo) const {
        const double F = conductor_fresnel(wo.z, eta_, 0.0);
        return 2.0 * F / (1.0 + F);
    }
    Rgb reflectance(const ShadingPoint&) const { return Rgb(1.0); }
    const ThinDielectric& white() const { return *this; }
    Rgb largest_albedo() const { return glm::max(reflectance_.upper_bound(), transmittance_.upper_bound()); }
    bool transmits() const { return true; }
    bool is_constant() const { return reflectance_.is_constant() && transmittance_.is_constant(); }
    bool is_grey() const { return reflectance_.is_grey() && transmittance_.is_grey(); }
    Lobe lobe() const { return {Lobe::Kind::specular, 0.0}; }

private:
    double eta_;
    SurfaceFunction reflectance_, transmittance_;
};

}  // namespace neumann
