// Mitsuba's `principled`: a blend of diffuse base, metal and rough glass, with sheen and a clear coat. One side of it; inside there
// is the glass only. With the facets of rough_conductor.h (GGX, separable masking), the weights d = (1 − metallic) (1 − spec_trans)
// and g = (1 − metallic) spec_trans, and c the base colour,
//
//     reflected     d c diffuse / π + (1 − metallic) sheen + ¼ clearcoat F D G + F̃ D G / (4 cosθi cosθo),
//     transmitted   g √c (1 − F) D G |ωi·m| |ωo·m| / (cosθi cosθo (ωo·m + η ωi·m)²),   m ∝ ωo + η ωi,
//
// where F̃ mixes Schlick's F of the metal, Fresnel's, and Schlick's with the base's tint. Transmitted is radiance, smaller by η²
// outside: fs(ωi → ωo) / n_o² is reciprocal, n_o the refractive index on the side of ωo. Energy is not conserved.
#pragma once

#include "core/material/bsdf_sample.h"
#include "core/material/lobe.h"
#include "core/material/principled_parameters.h"

#include <memory>

namespace neumann {

class Principled {
public:
    enum class Side { outside, inside };

    Principled(std::shared_ptr<const PrincipledParameters> parameters, Side side);

    Rgb eval(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const { return eval(values(p), wo, wi); }
    double pdf(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const { return pdf(values(p), wo, wi); }
    BsdfSample sample(const ShadingPoint& p, const Vec3& wo, const Vec2& u) const { return sample(values(p), wo, u); }
    Rgb reflectance(const ShadingPoint&) const { return Rgb(1.0); }
    const Principled& white() const { return *this; }
    // The albedo is measured.
    Rgb largest_albedo() const { return largest_albedo_; }
    bool is_constant() const { return parameters_->is_constant(); }
    bool is_lawful() const { return false; }
    bool needs_coordinates() const { return !is_constant() || !parameters_->is_isotropic(); }
    bool transmits() const { return !outside_ || !is_black(parameters_->spec_trans.upper_bound()); }
    bool is_grey() const { return parameters_->is_grey(); }
    Lobe lobe() const;

private:
    struct Probabilities;

    // The values at p; η is the refractive index of the other side divided by that of this side.
    PrincipledValues values(const ShadingPoint& p) const { return on_this_side((*parameters_)(p)); }
    PrincipledValues on_this_side(PrincipledValues v) const;
    Probabilities probabilities(const PrincipledValues& v, const Vec3& wo) const;
    Rgb eval(const PrincipledValues& v, const Vec3& wo, const Vec3& wi) const;
    double pdf(const PrincipledValues& v, const Vec3& wo, const Vec3& wi) const;
    BsdfSample sample(const PrincipledValues& v, const Vec3& wo, Vec2 u) const;

    std::shared_ptr<const PrincipledParameters> parameters_;
    bool outside_;
    Rgb largest_albedo_{0.0};
};

}  // namespace neumann
