// Lambert's ideal diffuse reflection: fs = ρ/π on the front side, nothing on the back (Mitsuba's `diffuse`).
#pragma once

#include "core/material/bsdf_sample.h"
#include "core/material/lobe.h"
#include "core/material/surface_function.h"
#include "core/sampling/warp.h"

namespace neumann {

class Diffuse {
public:
    explicit Diffuse(SurfaceFunction reflectance) : reflectance_(std::move(reflectance)) {}

    Rgb eval(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const {
        return wo.z > 0.0 && wi.z > 0.0 ? reflectance_(p) * inv_pi : Rgb(0.0);
    }
    double pdf(const ShadingPoint&, const Vec3& wo, const Vec3& wi) const { return wo.z > 0.0 && wi.z > 0.0 ? wi.z * inv_pi : 0.0; }
    // The weight is ρ itself and not a quotient, so that every path in the white furnace has exactly the throughput ρ^i.
    BsdfSample sample(const ShadingPoint& p, const Vec3& wo, const Vec2& u) const {
        if (wo.z <= 0.0) return {};
        const Vec3 wi = cosine_hemisphere(u);
        return {wi, reflectance_(p), wi.z * inv_pi};
    }
    Rgb reflectance(const ShadingPoint& p) const { return reflectance_(p); }
    Diffuse white() const { return Diffuse(Rgb(1.0)); }
    Rgb largest_albedo() const { return reflectance_.upper_bound(); }
    bool is_constant() const { return reflectance_.is_constant(); }
    bool is_grey() const { return reflectance_.is_grey(); }
    Lobe lobe() const { return {}; }

private:
    SurfaceFunction reflectance_;
};

}  // namespace neumann
