// Interface for inspecting paths that are traced again: their rays and their contributions.
#pragma once

#include "core/geometry/surface_point.h"

#include <cstdint>

namespace neumann {

// A ray that a path has cast, and its answer.
struct PathStep {
    enum class Kind {
        first,    // from the camera or from a light
        goes_on,  // after a reflection
        record,   // from a record of a cache
        asks  // a ray to a point on a light, on the other subpath, on the lens or shared by pixels, or in a direction sampled for
              // direct light
    };
    Kind kind = Kind::first;
    bool from_light = false;  // part of the subpath from a light
    int bounce = 0;           // number of reflections before the ray; for `asks`, including the one at its start
    SurfacePoint from;        // of a first ray from the camera, only the position is set
    Vec3 w{0.0};              // unit length
    double pdf = 0.0;         // after a reflection: of w, per solid angle, or delta_pdf; otherwise 0
    Rgb beta{0.0};            // throughput along the ray, or power of a path from a light; 0 for `asks`
    bool found = false;       // the ray hits something, or the point is visible
    SurfacePoint to;          // the hit, or the point
    bool is_shared = false;   // the point is one that paths of several pixels use, for this bounce and later ones
};

class PathObserver {
public:
    virtual ~PathObserver() = default;
    // Whether to report path number i, counted from 0.
    virtual bool watches(std::uint32_t) const { return true; }
    virtual void step(std::uint32_t path, const PathStep& step) = 0;
    // The contribution of a path's last step. `pixel`: the position on the film if a path from a light found it; otherwise null.
    virtual void found(std::uint32_t, std::size_t /*quantity*/, const Rgb&, const Vec2* /*pixel*/) {}
    // A photon map or a cache was read where the path has come to. Of the photon that brings most: the path from a light that left
    // it at a vertex. Of the record that brings most: its brightest ray; the vertex is the last one of the path.
    virtual void read(std::uint32_t, std::uint32_t /*read_path*/, std::uint32_t /*vertex*/, const Rgb&) {}
};

}  // namespace neumann
