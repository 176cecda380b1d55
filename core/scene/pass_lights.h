// Where a camera ray ends that goes through lights (Scene::hide_emitters).
#pragma once

#include "core/scene/scene.h"

namespace neumann {

// Who does not want to know on the way.
struct Untold {
    void operator()(const SurfacePoint& /*light*/, const SurfacePoint& /*beyond*/) const {}
};

// Moves x, which a ray along `direction` has hit, on to the first point that is on no light; false where there is none. T answers
// first_hits() as Geometry does. The rays cast are added to `rays`, and each is told as tell(light, beyond): what it leaves, and
// what it meets then, infinitely far away if that is nothing.
template <class Transport, class Tell = Untold>
bool pass_lights(const Emitters& emitters, const Transport& T, const Vec3& direction, SurfacePoint& x, std::uint64_t& rays,
                 const Tell& tell = {}) {
    while (emitters.is_emitter(x.shape)) {
        const SurfacePoint light = x;
        ++rays;
        const auto from = [&](std::size_t) { return std::pair<const SurfacePoint&, const Vec3&>(light, direction); };
        const bool found = T.first_hits(1, from, [&](std::size_t) -> SurfacePoint& { return x; }) != 0;
        if (!found) x.shape = SurfacePoint::infinity;
        tell(light, x);
        if (!found) return false;
    }
    return true;
}

}  // namespace neumann
