// A picture of another renderer.
#pragma once

#include "core/image/image.h"

#include <optional>
#include <string>

namespace neumann {

// Radiance in floats, from the only layer of the file, else from its channels R, G and B, else from its layer Combined or beauty.
// `layer`: from this one: its name, or the end of the name after a dot. Throws InputError, with the layers there are.
Image read_other_picture(const std::string& path, const std::optional<std::string>& layer);

}  // namespace neumann
