// (R g)(p, ωo) = ∫ fs(p, ωi → ωo) g(p, ωi) |cos θi| dωi: what leaves p is what arrives, scattered by the material. R needs
// materials only; no ray is traced here. The integral is estimated with one direction, drawn from the material's own density.
//
// The adjoint distributes what leaves p over the directions that it comes from: (R* f)(p, ωi) = ∫ fs(p, ωi → ωo) f(p,
// ωo) |cos θo| dωo.
#pragma once

#include "core/material/materials.h"
#include "operators/pointwise/adjoint_reflection.h"
#include "operators/pointwise/field.h"

namespace neumann {

class AdjointReflectionOperator;

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
    AdjointReflectionOperator adjoint() const;

private:
    const Materials* materials_;
};

class AdjointReflectionOperator {
public:
    using Domain = ExitantField;
    using Range = IncidentField;

    explicit AdjointReflectionOperator(const Materials& materials) : materials_(&materials) {}

    IncidentField operator()(ExitantField f) const {
        return IncidentField([materials = materials_, f = std::move(f)](const SurfacePoint& p, const Vec3& wi, Random& random) {
            if (p.is_infinite()) return Rgb(0.0);
            const SurfaceSide side = materials->side(p, wi);
            if (!side.bsdf) return Rgb(0.0);
            const AdjointReflection::Sample sampled = AdjointReflection::sample(*materials, side, wi, random.next2());
            if (is_black(sampled.weight)) return Rgb(0.0);
            return sampled.weight * f(p, sampled.wo, random);
        });
    }
    ReflectionOperator adjoint() const { return ReflectionOperator(*materials_); }

private:
    const Materials* materials_;
};

inline AdjointReflectionOperator ReflectionOperator::adjoint() const { return AdjointReflectionOperator(*materials_); }

}  // namespace neumann
