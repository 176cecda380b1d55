// Continues camera rays through lights (Scene::hide_emitters).
#pragma once

#include "core/scene/scene.h"

namespace neumann {

// The default callback, which does nothing.
struct ReportNothing {
    void operator()(const SurfacePoint& /*light*/, const SurfacePoint& /*beyond*/) const {}
};

// Moves x, the hit of a ray along `direction`, to the first hit that is not on a light. Returns false if there is none.
// T has first_hits() like Geometry. Adds the number of rays cast to `rays`, and calls tell(light, beyond) for each ray
// with the point on the light that it leaves and its next hit, which is at infinity if there is none.
template <class Transport, class Report = ReportNothing>
bool pass_lights(const Emitters& emitters, const Transport& T, const Vec3& direction, SurfacePoint& x, std::uint64_t& rays,
                 const Report& report = {}) {
    while (emitters.is_emitter(x.shape)) {
        const SurfacePoint light = x;
        ++rays;
        const auto from = [&](std::size_t) { return std::pair<const SurfacePoint&, const Vec3&>(light, direction); };
        const bool found = T.first_hits(1, from, [&](std::size_t) -> SurfacePoint& { return x; }) != 0;
        if (!found) x.shape = SurfacePoint::infinity;
        report(light, x);
        if (!found) return false;
    }
    return true;
}

}  // namespace neumann
