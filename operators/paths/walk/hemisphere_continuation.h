// The continuation (continuation.h) that draws directions without regard to the material: over the hemisphere on the walk's side of
// the surface, or over either where the material transmits, with one density for all surfaces (Dutré, Bekaert and Bala, Advanced
// Global Illumination, 5.4; the simplest estimators of indirect light):
//
//     uniform: pdf(ω) = 1 / 2π,        cosine: pdf(ω) = |cosθ| / π
//
// No such direction is that of a mirror: materials that have a delta lobe sample themselves.
#pragma once

#include "core/sampling/warp.h"
#include "operators/paths/walk/continuation.h"

namespace neumann {

enum class HemisphereDensity { uniform, cosine };

class HemisphereContinuation {
public:
    static constexpr bool joins_points = false;
    using VertexData = NoVertexData;

    explicit HemisphereContinuation(HemisphereDensity density) : density_(density) {}

    const HemisphereContinuation& at(const SurfaceSide&, VertexData) const { return *this; }

    template <class Sampler>
    BsdfSample sample(const SurfaceSide& side, const Vec3& wo, Sampler& sampler) const {
        const Vec2 u = sampler.next2();
        if (has_delta_lobe(side)) return neumann::sample(*side.bsdf, side.p, wo, u);
        BsdfSample sampled;
        sampled.wi = density_ == HemisphereDensity::cosine ? cosine_hemisphere(u) : uniform_hemisphere(u);
        if (wo.z < 0.0) sampled.wi.z = -sampled.wi.z;
        if (transmits(*side.bsdf) && sampler.next() >= 0.5) sampled.wi.z = -sampled.wi.z;
        sampled.pdf = pdf(side, wo, sampled.wi, {});
        if (!(sampled.pdf > 0.0)) return {};
        sampled.weight = eval(*side.bsdf, side.p, wo, sampled.wi) * (std::abs(sampled.wi.z) / sampled.pdf);
        return sampled;
    }
    double pdf(const SurfaceSide& side, const Vec3& wo, const Vec3& wi, const SurfacePoint&) const {
        if (has_delta_lobe(side)) return neumann::pdf(*side.bsdf, side.p, wo, wi);
        const bool both = transmits(*side.bsdf);
        if (!both && wi.z * wo.z <= 0.0) return 0.0;
        return (density_ == HemisphereDensity::cosine ? std::abs(wi.z) * inv_pi : 0.5 * inv_pi) * (both ? 0.5 : 1.0);
    }

private:
    static bool has_delta_lobe(const SurfaceSide& side) { return lobe(*side.bsdf).kind == Lobe::Kind::specular; }

    HemisphereDensity density_;
};

}  // namespace neumann
