// A material with holes (Mitsuba's `mask`): the fraction `opacity` of the light is scattered by the nested material, and the rest
// goes straight on, which counts as a bounce:
//
//     fs(ωi → ωo) = o fs'(ωi → ωo) + (1 − o) δ(ωi + ωo) / |cos θi|.
#pragma once

#include "core/material/bsdf_sample.h"
#include "core/material/lobe.h"
#include "core/material/surface_function.h"

#include <memory>

namespace neumann {

struct Bsdf;

class Mask {
public:
    // `nested`: the material of this side; null if it absorbs. `opacity` is in [0, 1] and equal in all channels.
    Mask(std::shared_ptr<const Bsdf> nested, SurfaceFunction opacity) : nested_(std::move(nested)), opacity_(std::move(opacity)) {}

    Rgb eval(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const;
    double pdf(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const;
    BsdfSample sample(const ShadingPoint& p, const Vec3& wo, Vec2 u) const;
    double pdf_from_light(const ShadingPoint& p, const Vec3& wi, const Vec3& wo) const;
    BsdfSample sample_from_light(const ShadingPoint& p, const Vec3& wi, Vec2 u) const;
    Rgb reflectance(const ShadingPoint&) const { return Rgb(1.0); }
    const Mask& white() const { return *this; }
    Rgb largest_albedo() const;
    Rgb largest_basic_albedo() const;
    bool transmits() const { return true; }
    double refractive_ratio() const;
    bool is_constant() const;
    bool needs_coordinates() const;
    bool is_grey() const;
    bool is_lawful() const;
    Lobe lobe() const { return {Lobe::Kind::specular, 0.0}; }

private:
    Rgb bound(const Rgb& nested) const;

    std::shared_ptr<const Bsdf> nested_;
    SurfaceFunction opacity_;
};

}  // namespace neumann
