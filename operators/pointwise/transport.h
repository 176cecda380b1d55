// (T f)(p, ω) = f(tr(p, ω), −ω): what arrives at p from ω is what left the first surface seen along ω. T needs geometry only.
//
// The adjoint, (T* g)(q, ω) = g(tr(q, ω), −ω), has the same form because rays go both ways, with ⟨f, g⟩ = ∫∫ f g |cos
// θ| dω dA. It is 0 where the ray leaves the scene.
#pragma once

#include "core/geometry/geometry.h"
#include "operators/pointwise/field.h"

namespace neumann {

class AdjointTransportOperator;

class TransportOperator {
public:
    using Domain = ExitantField;
    using Range = IncidentField;

    explicit TransportOperator(const Geometry& geometry) : geometry_(&geometry) {}

    IncidentField operator()(ExitantField f) const {
        return IncidentField([geometry = geometry_, f = std::move(f)](const SurfacePoint& p, const Vec3& w, Random& random) {
            SurfacePoint seen;
            if (!geometry->first_hit(p, w, seen)) seen.shape = SurfacePoint::infinity;
            return f(seen, -w, random);
        });
    }
    AdjointTransportOperator adjoint() const;

private:
    const Geometry* geometry_;
};

class AdjointTransportOperator {
public:
    using Domain = IncidentField;
    using Range = ExitantField;

    explicit AdjointTransportOperator(const Geometry& geometry) : geometry_(&geometry) {}

    ExitantField operator()(IncidentField g) const {
        return ExitantField([geometry = geometry_, g = std::move(g)](const SurfacePoint& q, const Vec3& w, Random& random) {
            SurfacePoint seen;
            if (q.is_infinite() || !geometry->first_hit(q, w, seen)) return Rgb(0.0);
            return g(seen, -w, random);
        });
    }
    TransportOperator adjoint() const { return TransportOperator(*geometry_); }

private:
    const Geometry* geometry_;
};

inline AdjointTransportOperator TransportOperator::adjoint() const { return AdjointTransportOperator(*geometry_); }

}  // namespace neumann
