// A smooth metal or mirror, with a delta lobe (Mitsuba's `conductor`). One-sided: the back reflects nothing.
//
//     fs(ωi → ωo) |cos θi| = ρ F(cos θi) δ(ωi − M ωo),   M ωo the mirror image of ωo, ρ a factor, 1 in nature.
#pragma once

#include "core/material/bsdf_sample.h"
#include "core/material/fresnel.h"
#include "core/material/lobe.h"
#include "core/material/surface_function.h"

namespace neumann {

class Conductor {
public:
    explicit Conductor(ConductorFresnel fresnel = {}, SurfaceFunction specular_reflectance = Rgb(1.0))
        : fresnel_(fresnel), reflectance_(std::move(specular_reflectance)) {}

    // A direction sampled otherwise is the mirror direction with probability 0.
    Rgb eval(const ShadingPoint&, const Vec3&, const Vec3&) const { return Rgb(0.0); }
    double pdf(const ShadingPoint&, const Vec3&, const Vec3&) const { return 0.0; }
    BsdfSample sample(const ShadingPoint& p, const Vec3& wo, const Vec2&) const {
        if (wo.z <= 0.0) return {};
        return {Vec3(-wo.x, -wo.y, wo.z), reflectance_(p) * fresnel_(wo.z), delta_pdf};
    }
    double choice(const Vec3&) const { return 1.0; }
    Rgb reflectance(const ShadingPoint& p) const { return reflectance_(p); }
    Conductor white() const { return Conductor(fresnel_); }
    // F reaches 1 at grazing angles.
    Rgb largest_albedo() const { return reflectance_.upper_bound(); }
    bool is_constant() const { return reflectance_.is_constant(); }
    bool is_grey() const { return reflectance_.is_grey() && fresnel_.is_grey(); }
    Lobe lobe() const { return {Lobe::Kind::specular, 0.0}; }

private:
    ConductorFresnel fresnel_;
    SurfaceFunction reflectance_;
};

}  // namespace neumann
