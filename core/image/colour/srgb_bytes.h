// The sRGB transfer function for pictures of eight bits.
#pragma once

#include <array>

namespace neumann {

// srgb_decode(i / 255) of each byte i: a picture has millions of texels, and the function takes a power.
const std::array<double, 256>& decoded_srgb_bytes();

}  // namespace neumann
