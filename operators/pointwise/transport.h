// (T f)(p, ω) = f(tr(p, ω), −ω): what arrives at p from ω is what left the first surface seen along ω. Geometry only.
#pragma once

#include "core/geometry/geometry.h"
#include "operators/pointwise/field.h"

namespace neumann {

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

private:
    const Geometry* geometry_;
};

}  // namespace neumann
