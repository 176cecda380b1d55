// R written as an integral over surfaces instead of directions (Dutré's surface formulations):
//
//     (R g)(x, ωo) = ∫_A fs(x, y → ωo) V(x, y) G(x, y) g(x, xy) dA(y),   G = |cos θx cos θy| / ‖x − y‖²,
//
// with xy the direction from x to y. y is drawn uniformly from all surfaces. Unlike the integral over directions, this
// one needs the visibility V, and it counts only what arrives from surfaces. A mirror has no fs to evaluate: its
// reflection cannot be written this way.
#pragma once

#include "core/base/error.h"
#include "core/geometry/area_sampler.h"
#include "core/material/materials.h"
#include "operators/pointwise/field.h"

namespace neumann {

class SurfaceReflectionOperator {
public:
    using Domain = IncidentField;
    using Range = ExitantField;

    // All three are kept by reference. Throws InputError if a material is a mirror.
    SurfaceReflectionOperator(const Geometry& geometry, const AreaSampler& surfaces, const Materials& materials)
        : geometry_(&geometry), surfaces_(&surfaces), materials_(&materials) {
        for (const Bsdf& bsdf : materials.bsdfs())
            if (lobe(bsdf).kind == Lobe::Kind::specular)
                throw InputError("reflection over surfaces is not possible with mirrors, expected diffuse or rough materials");
    }

    // fs V G between the points x and y, towards ωo.
    static Rgb kernel(const Geometry& geometry, const Materials& materials, const SurfacePoint& x, const Vec3& wo,
                      const SurfacePoint& y) {
        const SurfaceSide side = materials.side(x, wo);
        const Vec3 d = y.position - x.position;
        const double distance2 = glm::dot(d, d);
        if (!side.bsdf || distance2 == 0.0) return Rgb(0.0);
        const Vec3 wi = d / std::sqrt(distance2);
        const Frame& frame = side.p.frame;
        const Vec3 wi_local = frame.to_local(wi);
        const Rgb f = eval(*side.bsdf, side.p, frame.to_local(wo), wi_local);
        if (is_black(f) || !geometry.visible(x, y)) return Rgb(0.0);
        return f * std::abs(wi_local.z * glm::dot(y.normal, wi)) / distance2;
    }

    ExitantField operator()(IncidentField g) const {
        return ExitantField([*this, g = std::move(g)](const SurfacePoint& x, const Vec3& wo, Random& random) {
            if (x.is_infinite()) return Rgb(0.0);
            const double choice = random.next();
            const SurfacePoint y = surfaces_->sample(choice, random.next2());
            const Rgb weight = kernel(*geometry_, *materials_, x, wo, y) * surfaces_->area();
            return is_black(weight) ? Rgb(0.0) : weight * g(x, glm::normalize(y.position - x.position), random);
        });
    }

private:
    const Geometry* geometry_;
    const AreaSampler* surfaces_;
    const Materials* materials_;
};

}  // namespace neumann
