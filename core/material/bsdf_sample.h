// A direction drawn by a material.
#pragma once

#include "core/base/vec.h"

#include <limits>

namespace neumann {

// The pdf of a direction that is the only one possible, as in a mirror. The power heuristic then leaves the sample all its weight.
inline constexpr double delta_pdf = std::numeric_limits<double>::infinity();

struct BsdfSample {
    Vec3 wi{0.0};
    Rgb weight{0.0};   // fs |cosθi| / pdf; black when nothing is reflected
    double pdf = 0.0;  // per solid angle, or delta_pdf
};

}  // namespace neumann
