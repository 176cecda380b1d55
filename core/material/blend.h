// Two materials mixed (Mitsuba's `blendbsdf`): fs = (1 − w) fs₁ + w fs₂.
#pragma once

#include "core/material/bsdf_sample.h"
#include "core/material/lobe.h"
#include "core/material/surface_function.h"

#include <memory>

namespace neumann {

struct Bsdf;

class Blend {
public:
    // The materials are of this side; one of them may be null, which absorbs. `weight` is in [0, 1] and equal in all channels.
    Blend(std::shared_ptr<const Bsdf> first, std::shared_ptr<const Bsdf> second, SurfaceFunction weight)
        : first_(std::move(first)), second_(std::move(second)), weight_(std::move(weight)) {}

    Rgb eval(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const;
    double pdf(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const;
    // Chooses one material with the weight as probability; the pdf is that of the mixture.
    BsdfSample sample(const ShadingPoint& p, const Vec3& wo, Vec2 u) const;
    double pdf_from_light(const ShadingPoint& p, const Vec3& wi, const Vec3& wo) const;
    BsdfSample sample_from_light(const ShadingPoint& p, const Vec3& wi, Vec2 u) const;
    // Only a blend of diffuse materials has the form ρ(p) g.
    Rgb reflectance(const ShadingPoint& p) const;
    Bsdf white() const;
    Rgb largest_albedo() const;
    Rgb largest_basic_albedo() const;
    bool transmits() const;
    // The ratio of the first material that has one.
    double refractive_ratio() const;
    bool is_constant() const;
    bool needs_coordinates() const;
    bool is_grey() const;
    bool is_lawful() const;
    // The lobe of the sharper material.
    Lobe lobe() const;

private:
    template <class Bound>
    Rgb bound(const Bound& of) const;
    // Whether f is true for one of the two materials.
    template <class Predicate>
    bool any(const Predicate& f) const {
        return (first_ && f(*first_)) || (second_ && f(*second_));
    }

    std::shared_ptr<const Bsdf> first_, second_;
    SurfaceFunction weight_;
};

}  // namespace neumann
