// A direction drawn by a material.
#pragma once

#include "core/base/vec.h"
#include "core/sampling/delta_pdf.h"

namespace neumann {

struct BsdfSample {
    Vec3 wi{0.0};
    Rgb weight{0.0};   // fs |cosθi| / pdf; black when nothing is reflected
    double pdf = 0.0;  // per solid angle, or delta_pdf
    double eta = 1.0;  // of a refracted direction that is the only one: the refractive index there over that on ωo's side
};

}  // namespace neumann
