// Interface for inspecting paths that are traced again: their rays and their contributions.
#pragma once

#include "core/geometry/surface_point.h"

#include <cstdint>

namespace neumann {

// A ray that a path has cast, and what it found.
struct PathStep {
    enum class Kind {
        first,      // from the camera or from a light
        goes_on,    // after a reflection
        record,     // from a record of a cache
        shadow_ray  // a shadow ray to a light, the other subpath, the lens or a shared point, or a ray in a direction sampled
                    // for direct light
    };
    Kind kind = Kind::first;
    bool from_light = false;  // part of the subpath from a light
    int bounce = 0;           // number of reflections before the ray; for `shadow_ray`, including the one at its start
    SurfacePoint from;        // for a first ray from the camera, only the position is set
    Vec3 w{0.0};              // unit length
    double pdf = 0.0;         // pdf of w after a reflection, per solid angle, or delta_pdf; otherwise 0
    Rgb beta{0.0};            // throughput along the ray, or power of a path from a light; 0 for `shadow_ray`
    bool found = false;       // the ray hits something, or the point is visible
    SurfacePoint to;          // the hit, or the point
    bool is_shared = false;   // the point is one that paths of several pixels use, for this bounce and later ones
};

class PathObserver {
public:
    virtual ~PathObserver() = default;
    // Whether path number i, counted from 0, is to be reported.
    virtual bool watches(std::uint32_t) const { return true; }
    virtual void step(std::uint32_t path, const PathStep& step) = 0;
    // The contribution of a path's last step. `pixel` is the position on the film if a path from a light found it, otherwise null.
    virtual void found(std::uint32_t, std::size_t /*quantity*/, const Rgb&, const Vec2* /*pixel*/) {}
    // A photon map or a cache was read at the path's vertex. For the photon with the largest contribution, `read_path`
    // and `vertex` are the path from a light that left it and the vertex there. For the record with the largest
    // contribution, `read_path` is its brightest ray, and `vertex` the last one of the path.
    virtual void read(std::uint32_t, std::uint32_t /*read_path*/, std::uint32_t /*vertex*/, const Rgb&) {}
};

}  // namespace neumann
