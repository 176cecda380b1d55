// Makes pictures of at most 256 colours, as a GIF holds them.
#pragma once

#include "core/image/display.h"

#include <array>
#include <cstdint>
#include <vector>

namespace neumann {

using Colour = std::array<std::uint8_t, 3>;

struct IndexedImage {
    int width = 0, height = 0;
    std::vector<Colour> colours;       // 1 to 256
    std::vector<std::uint8_t> pixels;  // indices into `colours`, row 0 at the top
};

// Chooses at most 256 colours for which the sum of squared errors is small: boxes of colours are halved at their mean
// across the longer side, the one with the largest error first (Wan, Wong and Prusinkiewicz, An algorithm for
// multidimensional data clustering, ACM TOMS 14, 1988). The picture must have at least one pixel.
std::vector<Colour> choose_colours(const DisplayImage& picture);

// The picture in those colours, dithered by error diffusion.
IndexedImage with_few_colours(const DisplayImage& picture);

}  // namespace neumann
