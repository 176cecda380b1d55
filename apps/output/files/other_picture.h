// Reads a picture of another renderer.
#pragma once

#include "core/image/image.h"

#include <optional>
#include <string>

namespace neumann {

// Radiance in floats, from the only layer of the file, or else from its channels R, G and B, or else from its layer
// Combined or beauty. `layer`: the layer to read, by its name or the end of the name after a dot. Throws InputError,
// which lists the existing layers.
Image read_other_picture(const std::string& path, const std::optional<std::string>& layer);

}  // namespace neumann
