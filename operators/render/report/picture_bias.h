// The bias of pictures by methods that read light near a point, estimated from the difference between two radii.
#pragma once

#include "core/image/image.h"
#include "operators/render/from_paths/path_method.h"

namespace neumann {

// |bias| of each pixel. The bias of some methods has both signs, and so has the difference between the radii, but not at the same
// places; for these it is the root mean square over the neighbourhood of a pixel, an eighth of the picture wide.
Image stated_bias(const TwoRadii& radii, const Image& difference);

}  // namespace neumann
