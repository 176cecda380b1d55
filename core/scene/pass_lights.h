// Where a camera ray ends that goes through lights (Scene::hide_emitters).
#pragma once

#include "core/scene/scene.h"

namespace neumann {

// Moves x, which a ray along `direction` has hit, on to the first point that is on no light; false where there is none. T answers
// first_hits() as Geometry does. The rays cast are added to `rays`.
template <class Transport>
bool pass_lights(const Emitters& emitters, const Transport& T, const Vec3& direction, SurfacePoint& x, std::uint64_t& rays) {
    while (emitters.is_emitter(x.shape)) {
        const SurfacePoint light = x;
        ++rays;
        const auto from = [&](std::size_t) { return std::pair<const SurfacePoint&, const Vec3&>(light, direction); };
        if (T.first_hits(1, from, [&](std::size_t) -> SurfacePoint& { return x; }) == 0) return false;
    }
    return true;
}

}  // namespace neumann
