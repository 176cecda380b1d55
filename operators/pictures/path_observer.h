// Looks on while paths are traced again: ray by ray, and what they bring.
#pragma once

#include "core/geometry/surface_point.h"

#include <cstdint>

namespace neumann {

// A ray that a path has cast, and its answer.
struct PathStep {
    enum class Kind {
        first,    // from the camera or from a light
        goes_on,  // after a reflection
        asks      // is this point seen, of a light, of the other half or of the camera; or what is seen in this direction?
    };
    Kind kind = Kind::first;
    bool from_light = false;  // of the half that sets out from a light
    int bounce = 0;           // reflections behind it; a question counts the one that it is asked for
    SurfacePoint from;        // a first ray from the camera has a position alone
    Vec3 w{0.0};              // unit length
    double pdf = 0.0;         // of a camera path that goes on: of w, per solid angle, or delta_pdf; else 0
    Rgb beta{0.0};            // what the path weighs along the ray, or its power; a question has none
    bool found = false;       // there is something, or the point is seen
    SurfacePoint to;          // where that is
};

class PathObserver {
public:
    virtual ~PathObserver() = default;
    // Paths are numbered from 0; those that are not watched are not told of.
    virtual bool watches(std::uint32_t) const { return true; }
    virtual void step(std::uint32_t path, const PathStep& step) = 0;
    // What the last step of a path has brought. `pixel`: where on the film, of what comes from a light; else null.
    virtual void found(std::uint32_t, std::size_t /*quantity*/, const Rgb&, const Vec2* /*pixel*/) {}
};

}  // namespace neumann
