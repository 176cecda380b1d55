// R*, the adjoint of reflection, for paths from lights: it transports power where R transports radiance,
//
//     power along ωo per projected area = fs(ωi → ωo) |cosθo| · power along ωi,
//
// with geometric cosines. fs is evaluated from ωo's side, so it need not be reciprocal. If shading normals differ from geometric
// ones, R has |ωi·ns| in place of |ωi·ng|, and so must R* (Veach 1997, 5.3).
#pragma once

#include "core/material/materials.h"
#include "core/sampling/choose.h"
#include "core/sampling/third_number.h"
#include "core/sampling/warp.h"

#include <algorithm>

namespace neumann {

// fs(ωi → ωo) |ωi·ns| / |ωi·ng|: the kernel of R with respect to the geometric projected solid angle of ωi.
inline Rgb geometric_bsdf(const SurfaceSide& side_of_wo, const Vec3& wo, const Vec3& wi) {
    const ShadingPoint& p = side_of_wo.p;
    const Vec3 local = p.frame.to_local(wi);
    return eval(*side_of_wo.bsdf, p, p.frame.to_local(wo), local) * std::abs(local.z / glm::dot(p.normal, wi));
}

// The pdf, per solid angle, with which R samples ωi for radiance that leaves x along ωo.
inline double camera_pdf(const Materials& materials, const SurfacePoint& x, const Vec3& wo, const Vec3& wi) {
    const SurfaceSide side = materials.side(x, wo);
    return side.bsdf ? pdf(*side.bsdf, side.p, side.p.frame.to_local(wo), side.p.frame.to_local(wi)) : 0.0;
}

// Samples ωo for power that arrives from ωi, by BSDF sampling with the two directions exchanged. A BSDF that is not reciprocal
// might never sample some of the directions needed, so with probability 1/2 the direction is cosine-distributed instead.
class AdjointReflection {
public:
    struct Sample {
        Vec3 wo{0.0};
        Rgb weight{0.0};   // fs(ωi → ωo) |cosθo| / pdf
        double pdf = 0.0;  // per solid angle, or delta_pdf
    };

    // `side` is the side on which ωi is.
    static Sample sample(const Materials& materials, const SurfaceSide& side, const Vec3& wi, Vec2 u) {
        const Frame& frame = side.p.frame;
        const bool lawful = is_lawful(*side.bsdf);
        Sample result;
        if (lawful || choose_first(0.5, u.x)) {
            const BsdfSample drawn = sample_from_light(*side.bsdf, side.p, frame.to_local(wi), u);
            result.wo = frame.to_world(drawn.wi);
            result.pdf = drawn.pdf;
            if (drawn.pdf == delta_pdf) {
                result.weight = drawn.weight * (only_direction(side.p.normal, wi, result.wo, drawn.eta) * (lawful ? 1.0 : 2.0));
                return result;
            }
            if (!(drawn.pdf > 0.0)) return result;
        } else {
            Vec3 local = cosine_hemisphere(u);
            if (transmits(*side.bsdf) && third_number(u) < 0.5) local.z = -local.z;
            result.wo = frame.to_world(local);
        }
        if (!lawful) result.pdf = pdf(side, wi, result.wo);
        const SurfaceSide there = materials.side(side.p, result.wo);
        if (!there.bsdf || !(result.pdf > 0.0)) return {};
        result.weight = geometric_bsdf(there, result.wo, wi) * (std::abs(glm::dot(side.p.normal, result.wo)) / result.pdf);
        return result;
    }

    // The pdf of sample(), per solid angle, without delta lobes.
    static double pdf(const SurfaceSide& side, const Vec3& wi, const Vec3& wo) {
        const Vec3 local = side.p.frame.to_local(wo);
        const double drawn = pdf_from_light(*side.bsdf, side.p, side.p.frame.to_local(wi), local);
        if (is_lawful(*side.bsdf)) return drawn;
        const bool both = transmits(*side.bsdf);
        const double any = both ? 0.5 * std::abs(local.z) * inv_pi : std::max(local.z, 0.0) * inv_pi;
        return 0.5 * (drawn + any);
    }

private:
    // The factor between the weight of a delta lobe for R* and that for radiance. `a` is ωi, for which the BSDF was
    // sampled, and `b` the sampled direction. L/n² is conserved while the beam changes from dω(b) to dω(a) about the
    // normal m of the mirror or boundary, which follows from the two directions.
    static double only_direction(const Vec3& normal, const Vec3& a, const Vec3& b, double eta) {
        double beam = std::abs(glm::dot(normal, b) / glm::dot(normal, a));
        if (eta != 1.0) {
            const Vec3 m = a + b * eta;
            beam *= eta * eta * std::abs(glm::dot(m, a) / glm::dot(m, b));
        }
        return beam;
    }
};

// The pdf, per solid angle, with which R* samples ωo for power that arrives at x from ωi.
inline double light_pdf(const Materials& materials, const SurfacePoint& x, const Vec3& wi, const Vec3& wo) {
    const SurfaceSide side = materials.side(x, wi);
    return side.bsdf ? AdjointReflection::pdf(side, wi, wo) : 0.0;
}

}  // namespace neumann
