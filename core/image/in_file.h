// A picture as an OpenEXR file holds it: in floats.
#pragma once

#include "core/image/pixel_estimate.h"

namespace neumann {

// What read_exr() gives of encode_exr(): whoever shows this instead of the picture shows the same as who reads the file later.
PixelEstimate as_in_file(PixelEstimate picture);

}  // namespace neumann
