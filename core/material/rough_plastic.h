// A rough dielectric layer over a diffuse base (Mitsuba's `roughplastic`). One-sided. With the notation of plastic.h and
// rough_conductor.h,
//
//     fs(ωi → ωo) = s F(ωo·m) D(m) G1(ωi) G1(ωo) / (4 cosθi cosθo) + b T(cosθi) T(cosθo) / π,
//
// T the fraction of light from one direction that enters the layer, with single scattering by the facets, and F̄ in b the mean
// fraction that the facets reflect inside. Both are Mitsuba's sums: T is interpolated linearly between 64 equidistant cosines, and
// F̄ is 2/64 Σ R(μ) μ over these, 1.5% below the integral.
#pragma once

#include "core/material/beckmann.h"
#include "core/material/ggx.h"
#include "core/material/plastic.h"

#include <algorithm>
#include <array>
#include <memory>

namespace neumann {

class RoughTransmittance {
public:
    // Computed by Gauss quadrature over the visible facets.
    template <class Microfacets>
    RoughTransmittance(const Microfacets& facets, double eta);

    double operator()(double cosine) const {
        const double x = cosine * (nodes - 1);
        const int i = std::min(static_cast<int>(x), nodes - 2);
        return T_[i] + (x - i) * (T_[i + 1] - T_[i]);
    }
    // The mean over all directions, weighted by the cosine.
    double mean() const;
    double least() const { return *std::min_element(T_.begin(), T_.end()); }
    double largest() const { return *std::max_element(T_.begin(), T_.end()); }
    // F̄.
    double internal_reflectance() const { return internal_reflectance_; }

private:
    static constexpr int nodes = 64;
    std::array<double, nodes> T_;
    double internal_reflectance_ = 0.0;
};

template <class Microfacets>
class RoughPlastic {
public:
    RoughPlastic(const Microfacets& facets, double eta, SurfaceFunction diffuse_reflectance, SurfaceFunction specular_reflectance,
                 bool nonlinear)
        : facets_(facets),
          eta_(eta),
          transmittance_(std::make_shared<RoughTransmittance>(facets, eta)),
          base_(eta, transmittance_->internal_reflectance(), std::move(diffuse_reflectance), specular_reflectance, nonlinear),
          specular_(std::move(specular_reflectance)) {}

    Rgb eval(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const {
        if (wo.z <= 0.0 || wi.z <= 0.0) return Rgb(0.0);
        const Vec3 m = glm::normalize(wo + wi);
        const double F = conductor_fresnel(glm::dot(wo, m), eta_, 0.0);
        const double boundary = F * facets_.density(m) / (4.0 * facets_.projected_area(wo) * facets_.projected_area(wi));
        return specular_(p) * boundary + base_(p) * ((*transmittance_)(wo.z) * (*transmittance_)(wi.z) * inv_pi);
    }
    // Normalised over the whole sphere, as for a rough conductor.
    double pdf(const ShadingPoint&, const Vec3& wo, const Vec3& wi) const {
        const Vec3 h = wo + wi;
        if (wo.z <= 0.0 || h.z <= 0.0) return 0.0;
        const double probability = specular_probability(wo);
        return probability * facets_.density(glm::normalize(h)) / (4.0 * facets_.projected_area(wo)) +
               (1.0 - probability) * std::max(wi.z, 0.0) * inv_pi;
    }
    BsdfSample sample(const ShadingPoint& p, const Vec3& wo, Vec2 u) const {
        if (wo.z <= 0.0) return {};
        Vec3 wi;
        if (choose_first(specular_probability(wo), u.x)) {
            const Vec3 m = facets_.sample_visible(wo, u);
            wi = 2.0 * glm::dot(wo, m) * m - wo;
        } else {
            wi = cosine_hemisphere(u);
        }
        const double density = pdf(p, wo, wi);
        if (wi.z <= 0.0 || density == 0.0) return {wi, Rgb(0.0), density};
        return {wi, eval(p, wo, wi) * (wi.z / density), density};
    }
    Rgb reflectance(const ShadingPoint&) const { return Rgb(1.0); }
    const RoughPlastic& white() const { return *this; }
    // At most s (1 − T) + b T ∫ T(μ) 2μ dμ, because facets with single scattering reflect at most 1 − T. This is linear in T, so
    // its maximum is at the smallest or the largest T.
    Rgb largest_albedo() const {
        const Rgb s = specular_.upper_bound(), d = base_.upper_bound() * transmittance_->mean();
        const auto with = [&](double T) { return s * (1.0 - T) + d * T; };
        return glm::max(with(transmittance_->least()), with(transmittance_->largest()));
    }
    bool is_constant() const { return base_.is_constant() && specular_.is_constant(); }
    bool is_grey() const { return base_.is_grey() && specular_.is_grey(); }
    Lobe lobe() const { return {Lobe::Kind::rough, facets_.alpha().x}; }

private:
    double specular_probability(const Vec3& wo) const { return base_.specular_probability(1.0 - (*transmittance_)(wo.z)); }

    Microfacets facets_;
    double eta_;
    std::shared_ptr<const RoughTransmittance> transmittance_;
    CoatedBase base_;
    SurfaceFunction specular_;
};

}  // namespace neumann
