// A picture as its file holds it, for textures: row 0 at the top. Textures have colours of one or three channels, without alpha.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace neumann {

struct Texels {
    int width = 0, height = 0, channels = 0;
    // One of these is empty: bytes stay bytes, and other whole numbers become values from 0 to 1.
    std::vector<std::uint8_t> bytes = {};
    std::vector<float> values = {};
    bool is_encoded = false;  // whole numbers in the file, which are sRGB unless declared raw

    std::size_t index(int x, int y) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(channels);
    }
};

}  // namespace neumann
