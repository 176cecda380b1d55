// A diffuse part and a glossy lobe, added: fs = ρd/π + ρs g(ωi, ωo). One-sided. The lobes are in phong.h and ward.h.
#pragma once

#include "core/material/bsdf_sample.h"
#include "core/material/lobe.h"
#include "core/material/surface_function.h"
#include "core/sampling/choose.h"
#include "core/sampling/warp.h"

#include <algorithm>

namespace neumann {

// A `Glossy` has eval(), the reciprocal g for directions above the surface; pdf(), a density of ωi that is normalised
// over the whole sphere, since a lobe may reach below the horizon; sample(), which draws from it; and largest_albedo(),
// the largest ∫ g cosθ dω.
template <class Glossy>
class DiffuseAndGlossy {
public:
    DiffuseAndGlossy(Glossy glossy, SurfaceFunction diffuse_reflectance, SurfaceFunction specular_reflectance)
        : glossy_(std::move(glossy)), diffuse_(std::move(diffuse_reflectance)), specular_(std::move(specular_reflectance)) {
        const double s = mean_component(specular_.upper_bound()), d = mean_component(diffuse_.upper_bound());
        glossy_share_ = s + d > 0.0 ? s / (s + d) : 0.0;
    }

    Rgb eval(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const {
        if (wo.z <= 0.0 || wi.z <= 0.0) return Rgb(0.0);
        return diffuse_(p) * inv_pi + specular_(p) * glossy_.eval(p, wo, wi);
    }
    double pdf(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const {
        if (wo.z <= 0.0) return 0.0;
        return glossy_share_ * glossy_.pdf(p, wo, wi) + (1.0 - glossy_share_) * std::max(wi.z, 0.0) * inv_pi;
    }
    BsdfSample sample(const ShadingPoint& p, const Vec3& wo, Vec2 u) const {
        if (wo.z <= 0.0) return {};
        const Vec3 wi = choose_first(glossy_share_, u.x) ? glossy_.sample(p, wo, u) : cosine_hemisphere(u);
        const double density = pdf(p, wo, wi);
        if (wi.z <= 0.0 || density == 0.0) return {wi, Rgb(0.0), density};
        return {wi, eval(p, wo, wi) * (wi.z / density), density};
    }
    Rgb reflectance(const ShadingPoint&) const { return Rgb(1.0); }
    const DiffuseAndGlossy& white() const { return *this; }
    Rgb largest_albedo() const {
        Rgb largest = diffuse_.upper_bound();
        for (int c = 0; c < 3; ++c)
            if (const double s = specular_.upper_bound()[c]; s > 0.0)
                largest[c] += s * glossy_.largest_albedo();  // may be infinite
        return largest;
    }
    bool is_constant() const { return diffuse_.is_constant() && specular_.is_constant() && glossy_.is_constant(); }
    bool needs_coordinates() const { return !is_constant() || !glossy_.is_isotropic(); }
    bool is_grey() const { return diffuse_.is_grey() && specular_.is_grey(); }
    Lobe lobe() const { return {Lobe::Kind::rough, glossy_.alpha()}; }

private:
    Glossy glossy_;
    SurfaceFunction diffuse_, specular_;
    double glossy_share_;  // the probability of sampling the lobe
};

}  // namespace neumann
