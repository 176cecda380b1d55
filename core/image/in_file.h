// A picture as an OpenEXR file holds it: in floats.
#pragma once

#include "core/image/pixel_estimate.h"

namespace neumann {

// The picture that read_exr() reads from what encode_exr() writes: a picture shown before it is written looks the same as later.
PixelEstimate as_in_file(PixelEstimate picture);

}  // namespace neumann
