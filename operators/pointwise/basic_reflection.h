// Samples a direction of R for basic radiance L/n², which refraction conserves.
#pragma once

#include "core/material/materials.h"

namespace neumann {

struct BasicReflection {
    Vec3 wi{0.0};
    Rgb weight{0.0};     // fs |cosθ| / pdf for L/n²
    double pdf = 0.0;    // per solid angle, or delta_pdf; 0 if nothing is reflected
    double index = 1.0;  // refractive index on the side of ωi divided by that on the side of ωo

    // `wo` is in world coordinates and on `side`.
    static BasicReflection sample(const Materials&, const SurfaceSide& side, const Vec3& wo, const Vec2& u) {
        const BsdfSample sampled = neumann::sample(*side.bsdf, side.p, side.p.frame.to_local(wo), u);
        const double index = sampled.wi.z < 0.0 ? refractive_ratio(*side.bsdf) : 1.0;
        return {side.p.frame.to_world(sampled.wi), sampled.weight * (index * index), sampled.pdf, index};
    }
};

}  // namespace neumann
