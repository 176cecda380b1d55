// The bias of pictures by methods that read light near a point, estimated from the difference between two radii.
#pragma once

#include "core/image/image.h"
#include "operators/render/from_paths/path_method.h"

namespace neumann {

// |bias| of each pixel. Of a method that errs up and down, and so do the two radii, but not at the same places, it is the root mean
// square over the neighbourhood of a pixel, an eighth of the picture wide.
Image stated_bias(const TwoRadii& radii, const Image& difference);

}  // namespace neumann
