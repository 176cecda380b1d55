// (R g)(p, ωo) = ∫ fs(p, ωi → ωo) g(p, ωi) |cos θi| dωi: what leaves p is what arrives, scattered by the material. Materials only:
// no ray is traced here. The integral is estimated with one direction, drawn from the material's own density.
#pragma once

#include "core/material/materials.h"
#include "operators/pointwise/field.h"

namespace neumann {

class ReflectionOperator {
public:
    using Domain = IncidentField;
    using Range = ExitantField;

    explicit ReflectionOperator(const Materials& materials) : materials_(&materials) {}

    ExitantField operator()(IncidentField g) const {
        return ExitantField([materials = materials_, g = std::move(g)](const SurfacePoint& p, const Vec3& wo, Random& random) {
            if (p.is_infinite()) return Rgb(0.0);
            const SurfaceSide side = materials->side(p, wo);
            if (!side.bsdf) return Rgb(0.0);
            const Frame& frame = side.p.frame;
            const BsdfSample sampled = sample(*side.bsdf, side.p, frame.to_local(wo), random.next2());
            if (is_black(sampled.weight)) return Rgb(0.0);
            return sampled.weight * g(p, frame.to_world(sampled.wi), random);
        });
    }

private:
    const Materials* materials_;
};

}  // namespace neumann
