// Fields on a patch space: exitant radiance as a vector over the unknowns, incident radiance as what each ray of T brings. All
// colour channels side by side; C is 1 where a scene is grey, else 4, of which the last is zero: so many doubles the processor
// loads at once.
#pragma once

#include "core/base/vec.h"

#include <Eigen/Core>

#include <cstdint>

namespace neumann {

template <int C>
using Channels = Eigen::Array<double, C, 1>;

template <int C>
Channels<C> to_channels(const Rgb& c) {
    if constexpr (C == 1)
        return Channels<1>(c.r);
    else
        return Channels<4>(c.r, c.g, c.b, 0.0);
}
template <int C>
Rgb to_rgb(const Channels<C>& c) {
    if constexpr (C == 1)
        return Rgb(c[0]);
    else
        return Rgb(c[0], c[1], c[2]);
}

// One column an unknown, and a last one for PatchSpace::nothing(), which stays zero.
template <int C>
using ExitantVector = Eigen::Array<double, C, Eigen::Dynamic>;

}  // namespace neumann
