// Pictures at another size. Our own: Python shrinks pictures without loading the module that knows OpenImageIO.
#pragma once

#include "core/image/display.h"
#include "core/image/image.h"

namespace neumann {

// Each new pixel is the mean of `picture` over the area that it covers: an average where the picture shrinks, repeated pixels where
// it grows by a whole factor. Pixels that are not finite make those that they touch so. Throws std::invalid_argument for an empty
// size.
Image resized(const Image& picture, int width, int height);

// Each pixel `factor` times as wide and as high, at least once.
DisplayImage enlarged(const DisplayImage& picture, int factor);

}  // namespace neumann
