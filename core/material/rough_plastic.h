// A rough dielectric layer over a diffuse base (Mitsuba's `roughplastic`). One-sided. With the notation of plastic.h and
// rough_conductor.h,
//
//     fs(ωi → ωo) = s F(ωo·m) D(m) G1(ωi) G1(ωo) / (4 cosθi cosθo) + b T(cosθi) T(cosθo) / π,
//
// T the fraction of light from one direction that enters the layer, and F̄ in b the mean fraction that the facets reflect inside
// (rough_transmittance.h). The roughness is alike in all directions, and may vary over the surface.
#pragma once

#include "core/material/plastic.h"
#include "core/material/rough_transmittance.h"

#include <algorithm>
#include <memory>

namespace neumann {

template <class Microfacets>
class RoughPlastic {
public:
    RoughPlastic(Roughness<Microfacets> roughness, double eta, SurfaceFunction diffuse_reflectance,
                 SurfaceFunction specular_reflectance, bool nonlinear)
        : roughness_(std::move(roughness)),
          eta_(eta),
          transmittances_(std::make_shared<RoughTransmittances>(roughness_, eta)),
          base_(eta, transmittances_->tables().front().internal_reflectance(), std::move(diffuse_reflectance), specular_reflectance,
                nonlinear),
          specular_(std::move(specular_reflectance)) {}
    RoughPlastic(const Microfacets& facets, double eta, SurfaceFunction diffuse_reflectance, SurfaceFunction specular_reflectance,
                 bool nonlinear)
        : RoughPlastic(Roughness<Microfacets>(facets), eta, std::move(diffuse_reflectance), std::move(specular_reflectance),
                       nonlinear) {}

    Rgb eval(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const {
        if (wo.z <= 0.0 || wi.z <= 0.0) return Rgb(0.0);
        const Microfacets facets = roughness_(p);
        return eval(p, facets, transmittances_->at(facets.alpha().x), wo, wi);
    }
    // The pdf is normalised over the whole sphere, as for a rough conductor.
    double pdf(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const {
        const Microfacets facets = roughness_(p);
        return pdf(facets, specular_probability(transmittances_->at(facets.alpha().x), wo), wo, wi);
    }
    BsdfSample sample(const ShadingPoint& p, const Vec3& wo, Vec2 u) const {
        if (wo.z <= 0.0) return {};
        const Microfacets facets = roughness_(p);
        const RoughTransmittances::At T = transmittances_->at(facets.alpha().x);
        const double probability = specular_probability(T, wo);
        Vec3 wi;
        if (choose_first(probability, u.x)) {
            const Vec3 m = facets.sample_visible(wo, u);
            wi = 2.0 * glm::dot(wo, m) * m - wo;
        } else {
            wi = cosine_hemisphere(u);
        }
        const double density = pdf(facets, probability, wo, wi);
        if (wi.z <= 0.0 || density == 0.0) return {wi, Rgb(0.0), density};
        return {wi, eval(p, facets, T, wo, wi) * (wi.z / density), density};
    }
    Rgb reflectance(const ShadingPoint&) const { return Rgb(1.0); }
    const RoughPlastic& white() const { return *this; }
    // The albedo is at most s (1 − T) + b T ∫ T(μ) 2μ dμ, because facets with single scattering reflect at most 1 − T. This is
    // linear in T, so its maximum is at the smallest or the largest T; b and the integral are those of two neighbours in the table.
    Rgb largest_albedo() const {
        const Rgb s = specular_.upper_bound();
        const std::vector<RoughTransmittance>& tables = transmittances_->tables();
        Rgb largest(0.0);
        for (std::size_t i = 0; i < tables.size(); ++i) {
            const RoughTransmittance &a = tables[i], &b = tables[std::min(i + 1, tables.size() - 1)];
            const Rgb d =
                base_.upper_bound(std::max(a.internal_reflectance(), b.internal_reflectance())) * std::max(a.mean(), b.mean());
            for (const double T : {std::min(a.least(), b.least()), std::max(a.largest(), b.largest())})
                largest = glm::max(largest, s * (1.0 - T) + d * T);
        }
        return largest;
    }
    bool is_constant() const { return base_.is_constant() && specular_.is_constant() && roughness_.is_constant(); }
    bool is_grey() const { return base_.is_grey() && specular_.is_grey(); }
    Lobe lobe() const { return {Lobe::Kind::rough, roughness_.alpha()}; }

private:
    Rgb eval(const ShadingPoint& p, const Microfacets& facets, const RoughTransmittances::At& T, const Vec3& wo,
             const Vec3& wi) const {
        const Vec3 m = glm::normalize(wo + wi);
        const double F = conductor_fresnel(glm::dot(wo, m), eta_, 0.0);
        const double boundary = F * facets.density(m) / (4.0 * facets.projected_area(wo) * facets.projected_area(wi));
        return specular_(p) * boundary + base_(p, T.internal_reflectance()) * (T(wo.z) * T(wi.z) * inv_pi);
    }
    double pdf(const Microfacets& facets, double probability, const Vec3& wo, const Vec3& wi) const {
        const Vec3 h = wo + wi;
        if (wo.z <= 0.0 || h.z <= 0.0) return 0.0;
        return probability * facets.density(glm::normalize(h)) / (4.0 * facets.projected_area(wo)) +
               (1.0 - probability) * std::max(wi.z, 0.0) * inv_pi;
    }
    double specular_probability(const RoughTransmittances::At& T, const Vec3& wo) const {
        return base_.specular_probability(1.0 - T(wo.z));
    }

    Roughness<Microfacets> roughness_;
    double eta_;
    std::shared_ptr<const RoughTransmittances> transmittances_;
    CoatedBase base_;
    SurfaceFunction specular_;
};

}  // namespace neumann
