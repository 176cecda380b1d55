// A rough metal: microfacets that are mirrors, each hit once (Mitsuba's `roughconductor`). One-sided.
//
//     fs(ωi → ωo) = ρ F(ωo·m) D(m) G2(ωi, ωo) / (4 cosθi cosθo),   m ∝ ωi + ωo
//
// Torrance and Sparrow 1967; Smith's masking as in Heitz, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs,
// 2014. Light that hits a second facet is not followed, so a rough metal is darker than a smooth one.
#pragma once

#include "core/material/beckmann.h"
#include "core/material/bsdf_sample.h"
#include "core/material/fresnel.h"
#include "core/material/ggx.h"
#include "core/material/lobe.h"
#include "core/material/roughness.h"
#include "core/material/surface_function.h"

namespace neumann {

// G2: masking in the two directions is independent, or correlated by the height of the facet.
enum class Masking {
    separable,         // G1(ωi) G1(ωo), as in Mitsuba
    height_correlated  // 1 / (1 + Λ(ωi) + Λ(ωo)), G1 = 1 / (1 + Λ)
};

// All formulas use the projected areas a(v) = cosθ (1 + Λ(v)) of the facets, which do not vanish at grazing angles.
template <class Microfacets>
class RoughConductor {
public:
    explicit RoughConductor(Roughness<Microfacets> roughness, ConductorFresnel fresnel = {},
                            SurfaceFunction specular_reflectance = Rgb(1.0), Masking masking = Masking::separable)
        : roughness_(std::move(roughness)), fresnel_(fresnel), reflectance_(std::move(specular_reflectance)), masking_(masking) {}
    explicit RoughConductor(const Microfacets& facets, ConductorFresnel fresnel = {},
                            SurfaceFunction specular_reflectance = Rgb(1.0), Masking masking = Masking::separable)
        : RoughConductor(Roughness<Microfacets>(facets), fresnel, std::move(specular_reflectance), masking) {}

    Rgb eval(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const {
        if (wo.z <= 0.0 || wi.z <= 0.0) return Rgb(0.0);
        const Microfacets facets = roughness_(p);
        const Vec3 m = glm::normalize(wo + wi);
        return reflectance_(p) * fresnel_(glm::dot(wo, m)) * (facets.density(m) / (4.0 * area(facets, wo, wi)));
    }
    // The pdf is normalised over the whole sphere: sampling visible normals also gives ωi below the horizon, where fs is 0.
    double pdf(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const {
        const Vec3 h = wo + wi;
        if (wo.z <= 0.0 || h.z <= 0.0) return 0.0;
        const Microfacets facets = roughness_(p);
        return facets.density(glm::normalize(h)) / (4.0 * facets.projected_area(wo));
    }
    BsdfSample sample(const ShadingPoint& p, const Vec3& wo, const Vec2& u) const {
        if (wo.z <= 0.0) return {};
        const Microfacets facets = roughness_(p);
        const Vec3 m = facets.sample_visible(wo, u);
        const double cosine = glm::dot(wo, m), seen = facets.projected_area(wo);
        const Vec3 wi = 2.0 * cosine * m - wo;
        const double pdf = facets.density(m) / (4.0 * seen);
        if (wi.z <= 0.0) return {wi, Rgb(0.0), pdf};
        return {wi, reflectance_(p) * fresnel_(cosine) * (wi.z * seen / area(facets, wo, wi)), pdf};
    }
    Rgb reflectance(const ShadingPoint& p) const { return reflectance_(p); }
    RoughConductor white() const { return RoughConductor(roughness_, fresnel_, Rgb(1.0), masking_); }
    // Each facet is seen at most once, and F ≤ 1.
    Rgb largest_albedo() const { return reflectance_.upper_bound(); }
    bool is_constant() const { return reflectance_.is_constant() && roughness_.is_constant(); }
    bool needs_coordinates() const { return !is_constant() || !roughness_.is_isotropic(); }
    bool is_grey() const { return reflectance_.is_grey() && fresnel_.is_grey(); }
    Lobe lobe() const { return {Lobe::Kind::rough, roughness_.alpha()}; }

private:
    // cosθi cosθo / G2.
    double area(const Microfacets& facets, const Vec3& wo, const Vec3& wi) const {
        const double o = facets.projected_area(wo), i = facets.projected_area(wi);
        return masking_ == Masking::separable ? o * i : wo.z * i + wi.z * o - wo.z * wi.z;
    }

    Roughness<Microfacets> roughness_;
    ConductorFresnel fresnel_;
    SurfaceFunction reflectance_;
    Masking masking_;
};

}  // namespace neumann
