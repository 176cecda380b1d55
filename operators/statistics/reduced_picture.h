// A picture in fewer pixels, with the errors that these have.
#pragma once

#include "core/image/pixel_estimate.h"

namespace neumann {

// Each new pixel is the mean of factor × factor old ones, of those that there are at the right and lower edge. Standard errors add
// up in squares where pixels are independent, and as they are otherwise; so does the discretisation, which goes together. What few
// samples leave open falls as there are more.
PixelEstimate reduced(const PixelEstimate& picture, int factor);

}  // namespace neumann
