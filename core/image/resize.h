// Resizes pictures without OpenImageIO, so that Python need not load its module to shrink pictures.
#pragma once

#include "core/image/display.h"
#include "core/image/image.h"

namespace neumann {

// Each new pixel is the mean of `picture` over the area that it covers: an average where the picture shrinks, repeated pixels where
// it grows by a whole factor. Pixels that are not finite make those that they touch so. Throws std::invalid_argument for an empty
// size.
Image resized(const Image& picture, int width, int height);

// Repeats each pixel `factor` times along both axes, at least once.
DisplayImage enlarged(const DisplayImage& picture, int factor);

}  // namespace neumann
