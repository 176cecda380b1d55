// A surface that is not there (Mitsuba's `null`): light goes straight on, fs(ωi → ωo) |cos θi| = δ(ωi + ωo). It counts as a bounce.
#pragma once

#include "core/material/bsdf_sample.h"
#include "core/material/lobe.h"
#include "core/material/surface_function.h"

namespace neumann {

class Null {
public:
    Rgb eval(const ShadingPoint&, const Vec3&, const Vec3&) const { return Rgb(0.0); }
    double pdf(const ShadingPoint&, const Vec3&, const Vec3&) const { return 0.0; }
    BsdfSample sample(const ShadingPoint&, const Vec3& wo, const Vec2&) const { return {-wo, Rgb(1.0), delta_pdf}; }
    Rgb reflectance(const ShadingPoint&) const { return Rgb(1.0); }
    Null white() const { return {}; }
    Rgb largest_albedo() const { return Rgb(1.0); }
    bool transmits() const { return true; }
    bool is_constant() const { return true; }
    bool is_grey() const { return true; }
    Lobe lobe() const { return {Lobe::Kind::specular, 0.0}; }
};

}  // namespace neumann
