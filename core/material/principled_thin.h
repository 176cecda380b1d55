// Mitsuba's `principledthin`: a sheet, the same on both sides, that reflects and lets through diffusely and as thin rough glass.
// With the facets of rough_conductor.h, t = spec_trans, d = diff_trans / 2, c the base colour, and ωi′ the mirror image of ωi above
// the sheet,
//
//     reflected     (1 − t) (1 − d) (c diffuse / π + sheen) + t F̃ D G / (4 cosθi cosθo),   m ∝ ωo + ωi,
//     transmitted   (1 − t) d c / π + t c (1 − F) D′ G′ / (4 cosθi cosθo),                  m ∝ ωo + ωi′,
//
// F̃ with a tint as principled.h's, D′ and G′ of facets whose roughness is (0.65 η − 0.35) times as large. What is let through
// counts only where ωi·m < 0, which looks at ωi and not at ωo: at grazing angles that is not reciprocal.
#pragma once

#include "core/material/bsdf_sample.h"
#include "core/material/lobe.h"
#include "core/material/principled_parameters.h"

#include <memory>

namespace neumann {

class PrincipledThin {
public:
    explicit PrincipledThin(std::shared_ptr<const PrincipledParameters> parameters);

    Rgb eval(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const { return eval((*parameters_)(p), wo, wi); }
    double pdf(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const { return pdf((*parameters_)(p), wo, wi); }
    BsdfSample sample(const ShadingPoint& p, const Vec3& wo, const Vec2& u) const { return sample((*parameters_)(p), wo, u); }
    Rgb reflectance(const ShadingPoint&) const { return Rgb(1.0); }
    const PrincipledThin& white() const { return *this; }
    // The albedo is measured.
    Rgb largest_albedo() const { return largest_albedo_; }
    bool is_constant() const { return parameters_->is_constant(); }
    bool is_lawful() const { return false; }
    bool needs_coordinates() const { return !is_constant() || !parameters_->is_isotropic(); }
    bool transmits() const {
        return !is_black(parameters_->spec_trans.upper_bound()) || !is_black(parameters_->diff_trans.upper_bound());
    }
    bool is_grey() const { return parameters_->is_grey(); }
    Lobe lobe() const;

private:
    static Rgb eval(const PrincipledValues& v, const Vec3& wo, const Vec3& wi);
    static double pdf(const PrincipledValues& v, const Vec3& wo, const Vec3& wi);
    static BsdfSample sample(const PrincipledValues& v, const Vec3& wo, Vec2 u);

    std::shared_ptr<const PrincipledParameters> parameters_;
    Rgb largest_albedo_{0.0};
};

}  // namespace neumann
