// A direction drawn by a material.
#pragma once

#include "core/base/vec.h"
#include "core/sampling/delta_pdf.h"

namespace neumann {

struct BsdfSample {
    Vec3 wi{0.0};
    Rgb weight{0.0};   // fs |cosθi| / pdf; black when nothing is reflected
    double pdf = 0.0;  // per solid angle, or delta_pdf
};

}  // namespace neumann
