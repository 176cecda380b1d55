// Packets of tev, a picture viewer (https://github.com/Tom94/tev, include/tev/Ipc.h): the length in bytes, which includes its own
// four, a byte for the operation, and then its values one after the other; texts end with a zero byte, numbers are little-endian.
#pragma once

#include "core/image/image.h"

#include <string>
#include <vector>

namespace neumann {

// "bounce_003.R", "bounce_003.G", "bounce_003.B"; for the layer "" simply "R", "G", "B".
std::vector<std::string> tev_channels(const std::string& layer);

// Creates an image of this name with channels that are black. It replaces one of the same name.
std::string tev_create_image(const std::string& name, int width, int height, const std::vector<std::string>& channels);
std::string tev_update_image(const std::string& name, const std::string& layer, const Image& picture);

}  // namespace neumann
