// A point on a surface, as ray casting or area sampling finds it.
#pragma once

#include "core/base/vec.h"

#include <cstdint>

namespace neumann {

struct SurfacePoint {
    // The shape of a point infinitely far away, where rays end that hit nothing.
    static constexpr std::uint32_t infinity = 0xffffffffu;

    Vec3 position;            // scene units
    Vec3 normal;              // unit length, geometric, on the front side
    double error = 0.0;       // rays start this far along ±normal: the rounding error of the hit, scene units
    std::uint32_t shape = 0;  // index into Geometry::shapes()
    std::uint32_t primitive : 31 = 0;
    // Whether other surfaces are within rounding; rays then start at `position` and are intersected with them in double.
    bool close : 1 = false;

    bool is_infinite() const { return shape == infinity; }
};

}  // namespace neumann
