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
    // Of this side; null where one absorbs, which not both do. `weight` is in [0, 1], alike in all channels.
    Blend(std::shared_ptr<const Bsdf> first, std::shared_ptr<const Bsdf> second, SurfaceFunction weight)
        : first_(std::move(first)), second_(std::move(second)), weight_(std::move(weight)) {}

    Rgb eval(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const;
    double pdf(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const;
    // One is chosen by the weight; a direction that both may give has the density of both.
    BsdfSample sample(const ShadingPoint& p, const Vec3& wo, Vec2 u) const;
    // Only diffuse materials add up to ρ(p) g.
    Rgb reflectance(const ShadingPoint& p) const;
    Bsdf white() const;
    Rgb largest_albedo() const;
    Rgb largest_basic_albedo() const;
    bool transmits() const;
    // The first one's that has one.
    double refractive_ratio() const;
    bool is_constant() const;
    bool needs_coordinates() const;
    bool is_grey() const;
    bool is_lawful() const;
    // The sharper one's.
    Lobe lobe() const;

private:
    template <class Bound>
    Rgb bound(const Bound& of) const;
    // f is true of one of the two.
    template <class Predicate>
    bool any(const Predicate& f) const {
        return (first_ && f(*first_)) || (second_ && f(*second_));
    }

    std::shared_ptr<const Bsdf> first_, second_;
    SurfaceFunction weight_;
};

}  // namespace neumann
