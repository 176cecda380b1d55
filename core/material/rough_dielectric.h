// A rough boundary between two transparent media, seen from one of them (Mitsuba's `roughdielectric`): microfacets that are smooth
// boundaries, each met once. The other side is another RoughDielectric, with 1/η. With the notation of dielectric.h and
// rough_conductor.h, Smith's separable masking, and all cosines taken as positive,
//
//     fs(ωi → ωo) = R F(ωo·m) D(m) G1(ωi) G1(ωo) / (4 cosθi cosθo)                          above, m ∝ ωo + ωi,
//     fs(ωi → ωo) = T (1 − F(ωo·m)) D(m) G1(ωi) G1(ωo) (ωo·m) |ωi·m| /
//                   (cosθi cosθo |ωo + η ωi|²)                                              below, m ∝ ±(ωo + η ωi).
//
// Walter et al., Microfacet Models for Refraction through Rough Surfaces, 2007, where the η² of eq. 21 is cancelled by the 1/η² of
// radiance. Visible normals are sampled on both sides (Heitz and d'Eon 2014).
#pragma once

#include "core/material/beckmann.h"
#include "core/material/bsdf_sample.h"
#include "core/material/fresnel.h"
#include "core/material/ggx.h"
#include "core/material/lobe.h"
#include "core/material/roughness.h"
#include "core/material/surface_function.h"
#include "core/sampling/third_number.h"

namespace neumann {

template <class Microfacets>
class RoughDielectric {
public:
    RoughDielectric(Roughness<Microfacets> roughness, double eta, SurfaceFunction specular_reflectance = Rgb(1.0),
                    SurfaceFunction specular_transmittance = Rgb(1.0))
        : roughness_(std::move(roughness)),
          eta_(eta),
          reflectance_(std::move(specular_reflectance)),
          transmittance_(std::move(specular_transmittance)) {}

    Rgb eval(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const {
        if (wo.z <= 0.0 || wi.z == 0.0) return Rgb(0.0);
        return scattered(p, At(*this, p, wo), wi) / std::abs(wi.z);
    }
    // The pdf is normalised over the whole sphere. Facets may also reflect downwards and refract upwards, which is not
    // part of fs; sample() gives such directions the weight that fs has there.
    double pdf(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const {
        if (wo.z <= 0.0) return 0.0;
        const At at(*this, p, wo);
        return at.reflected(wi) + at.refracted(wi);
    }
    BsdfSample sample(const ShadingPoint& p, const Vec3& wo, const Vec2& u) const {
        if (wo.z <= 0.0) return {};
        const At at(*this, p, wo);
        const Vec3 m = at.facets.sample_visible(wo, u);
        const double cosine = glm::dot(wo, m);
        const bool reflects = third_number(u) < conductor_fresnel(cosine, eta_, 0.0);
        const double q = reflects ? 0.0 : std::sqrt((eta_ - 1.0) * (eta_ + 1.0) + cosine * cosine);
        const Vec3 wi = reflects ? 2.0 * cosine * m - wo : ((cosine - q) * m - wo) / eta_;
        const double density = at.reflected(wi) + at.refracted(wi);
        if (density == 0.0) return {};
        return {wi, scattered(p, at, wi) / density, density};
    }
    Rgb reflectance(const ShadingPoint&) const { return Rgb(1.0); }
    const RoughDielectric& white() const { return *this; }
    // Each facet is seen at most once.
    Rgb largest_albedo() const { return glm::max(reflectance_.upper_bound(), transmittance_.upper_bound() / (eta_ * eta_)); }
    Rgb largest_basic_albedo() const { return glm::max(reflectance_.upper_bound(), transmittance_.upper_bound()); }
    bool transmits() const { return true; }
    double refractive_ratio() const { return eta_; }
    bool is_constant() const { return reflectance_.is_constant() && transmittance_.is_constant() && roughness_.is_constant(); }
    bool needs_coordinates() const { return !is_constant() || !roughness_.is_isotropic(); }
    bool is_grey() const { return reflectance_.is_grey() && transmittance_.is_grey(); }
    Lobe lobe() const { return {Lobe::Kind::rough, roughness_.alpha()}; }

private:
    // The facets at a point, as they are seen along ωo.
    struct At {
        Microfacets facets;
        double eta;
        Vec3 wo;
        double seen;

        At(const RoughDielectric& bsdf, const ShadingPoint& p, const Vec3& w)
            : facets(bsdf.roughness_(p)), eta(bsdf.eta_), wo(w), seen(facets.projected_area(w)) {}

        // The densities of the directions in which the facets reflect and refract.
        double reflected(const Vec3& wi) const {
            const Vec3 h = wo + wi;
            if (h.z <= 0.0) return 0.0;
            const Vec3 m = glm::normalize(h);
            return conductor_fresnel(glm::dot(wo, m), eta, 0.0) * facets.density(m) / (4.0 * seen);
        }
        double refracted(const Vec3& wi) const {
            const Vec3 h = wo + eta * wi;
            const double length2 = glm::dot(h, h);
            if (length2 == 0.0) return 0.0;
            const Vec3 m = h * (std::copysign(1.0, h.z) / std::sqrt(length2));
            const double o = glm::dot(wo, m), i = -glm::dot(wi, m);
            if (o <= 0.0 || i <= 0.0) return 0.0;
            const double turn = eta * eta * i / length2;  // solid angle of m over that of ωi
            return (1.0 - conductor_fresnel(o, eta, 0.0)) * facets.density(m) * o * turn / seen;
        }
    };

    // fs |cosθi|.
    Rgb scattered(const ShadingPoint& p, const At& at, const Vec3& wi) const {
        const double G1 = std::abs(wi.z) / at.facets.projected_area(Vec3(wi.x, wi.y, std::abs(wi.z)));
        if (wi.z > 0.0) return reflectance_(p) * (at.reflected(wi) * G1);
        return transmittance_(p) * (at.refracted(wi) * G1 / (eta_ * eta_));
    }

    Roughness<Microfacets> roughness_;
    double eta_;
    SurfaceFunction reflectance_, transmittance_;
};

}  // namespace neumann
