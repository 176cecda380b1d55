#pragma once

#include "core/image/pixel_estimate.h"

namespace neumann {

// Reduces a picture to fewer pixels, with their errors. Each new pixel is the mean of factor × factor old ones, or of
// those that exist at the right and lower edge. Standard errors add up in squares if pixels are independent, and
// linearly otherwise. Discretisation errors are correlated and add up linearly. The lower bounds on the errors
// (least_errors.h) are divided by the number of pixels, because there are more samples.
PixelEstimate reduced(const PixelEstimate& picture, int factor);

}  // namespace neumann
