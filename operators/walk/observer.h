// What paths tell whoever looks on, each of its own in order. Nobody costs nothing: nothing is left of a call of an empty function.
#pragma once

#include "operators/walk/path_end.h"

#include <cstddef>
#include <cstdint>

namespace neumann {

struct NoObserver {
    // A path casts a ray from its end, with so many reflections behind it; then what the ray meets, infinitely far away if that is
    // nothing.
    void casts(std::uint32_t /*path*/, bool /*from_light*/, int /*reflections*/, const PathEnd&) const {}
    void meets(std::uint32_t /*path*/, const SurfacePoint&) const {}
    // For this bounce x has asked by a ray whether it sees y, or what is seen along w, which is y. `w`: towards y, of any length.
    void asks(std::uint32_t /*path*/, bool /*from_light*/, int /*bounce*/, const SurfacePoint& /*x*/, const Vec3& /*w*/,
              const SurfacePoint& /*y*/, bool /*seen*/) const {}
    // What it has just met or seen adds to a quantity. Light tracing and bidirectional paths have callbacks for it.
    void finds(std::uint32_t /*path*/, std::size_t /*quantity*/, const Rgb&) const {}
};

}  // namespace neumann
