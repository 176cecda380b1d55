// The bias of pictures by methods that read light near a point, estimated from the difference between two radii.
#pragma once

#include "core/image/image.h"
#include "operators/render/from_paths/sampling_settings.h"

namespace neumann {

// The difference as a part of the bias: of photon maps that between the radii r and r/√2, of a cache that between r√2 and r. Where
// light has edges the error is of order r, and the difference 0.29 or 0.41 of it; where it is smooth, of order r², and the difference
// a half with photon maps, and the whole with a cache. Photon maps are taken at the former. Of a cache it is a third, as the grid
// convergence index has it for two grids and an order of 2 (Roache, Perspective: A Method for Uniform Reporting of Grid Refinement
// Studies, 1994).
double part_of_bias(PathGenerator generator);

// |bias| of each pixel. A cache errs up and down between its records, and so do the two radii, but not at the same places: its
// bias is the root mean square over the neighbourhood of a pixel, an eighth of the picture wide.
Image stated_bias(PathGenerator generator, const Image& difference);

}  // namespace neumann
