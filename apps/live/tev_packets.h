// Packets of tev, a viewer of pictures (https://github.com/Tom94/tev, include/tev/Ipc.h): their length in bytes with these four, a
// byte that says what is to be done, and then its values one after the other; texts end with a zero, numbers begin with the lowest
// byte.
#pragma once

#include "core/image/image.h"

#include <string>
#include <vector>

namespace neumann {

// "bounce_003.R", "bounce_003.G", "bounce_003.B"; of the layer "" as well "R", "G", "B".
std::vector<std::string> tev_channels(const std::string& layer);

// An image of this name with channels that are black as yet. It replaces one of the same name.
std::string tev_create_image(const std::string& name, int width, int height, const std::vector<std::string>& channels);
// What is in the channels of a layer.
std::string tev_update_image(const std::string& name, const std::string& layer, const Image& picture);

}  // namespace neumann
