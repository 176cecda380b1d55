// Callbacks of paths, for code that inspects them; the calls for one path come in its order. NoObserver costs nothing, because its
// empty functions are inlined.
#pragma once

#include "operators/paths/walk/path_end.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace neumann {

struct NoObserver {
    // A path casts a ray from its end after this many reflections. Then meets() gets the hit, or a point at infinity if
    // there is none.
    void casts(std::uint32_t /*path*/, bool /*from_light*/, int /*reflections*/, const PathEnd&) const {}
    void meets(std::uint32_t /*path*/, const SurfacePoint&) const {}
    // A ray for a light sample or a connection of this bounce was cast from x, either to the given point y, or along w,
    // where it found y. `w` points towards y and may have any length.
    void casts_shadow_ray(std::uint32_t /*path*/, bool /*from_light*/, int /*bounce*/, const SurfacePoint& /*x*/, const Vec3& /*w*/,
                          const SurfacePoint& /*y*/, bool /*seen*/) const {}
    // A ray was cast to a point that paths of several pixels share, of which more is known than its direct light.
    void joins(std::uint32_t /*path*/, int /*bounce*/, const SurfacePoint& /*x*/, const SurfacePoint& /*y*/, bool /*seen*/) const {}
    // The last meets(), casts_shadow_ray() or joins() adds this contribution to a quantity. Light tracing and bidirectional paths
    // use callbacks instead.
    void finds(std::uint32_t /*path*/, std::size_t /*quantity*/, const Rgb&) const {}
    // Before the reflection of this bounce walks have become others, which are branches of those of these numbers.
    template <class Walkers>
    void branches(int /*bounce*/, const Walkers&, std::span<const std::uint32_t> /*of*/) const {}
    // Photons or records were read at the path's vertex. Of these, the one with the largest contribution is reported: a
    // photon by the number of its path from a light and the vertex, or a record by the number of its ray.
    void reads(std::uint32_t /*path*/, std::uint32_t /*read_path*/, std::uint32_t /*vertex*/, const Rgb&) const {}
};

}  // namespace neumann
