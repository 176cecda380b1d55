// The end of an unfinished path, from the camera or from a light.
#pragma once

#include "core/geometry/surface_point.h"

namespace neumann {

struct PathEnd {
    SurfacePoint x;            // position of the end
    Vec3 w{0.0};               // direction in which it leaves x
    double pdf = 0.0;          // pdf of w, per solid angle, or delta_pdf
    Rgb beta{1.0};             // throughput, or the power that a path from a light carries
    double kept_weight = 0.0;  // largest channel of β when the path last survived roulette
};

}  // namespace neumann
