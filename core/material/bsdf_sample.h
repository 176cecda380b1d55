// A direction sampled from a BSDF.
#pragma once

#include "core/base/vec.h"
#include "core/sampling/delta_pdf.h"

namespace neumann {

struct BsdfSample {
    Vec3 wi{0.0};
    Rgb weight{0.0};   // fs |cosθi| / pdf; black when nothing is reflected
    double pdf = 0.0;  // per solid angle, or delta_pdf
    double eta = 1.0;  // for a refracted delta direction: the refractive index on its side divided by that on ωo's side
};

}  // namespace neumann
