// The places where pictures differ most: a few blocks of pixels, with a path of our own through each.
#pragma once

#include "operators/experiments/blame/difference_test.h"
#include "operators/experiments/blame/our_path.h"

#include <vector>

namespace neumann {

struct WorstPlace {
    int x = 0, y = 0, width = 0, height = 0;  // in pixels
    Rgb theirs{0.0}, ours{0.0};               // means over the block
    double z = 0.0;                           // for the channel that differs most, in standard errors
    int pixel_x = 0, pixel_y = 0;             // the pixel that differs most in the block
    OurPath path;                             // a path through this pixel
};

// The blocks of block_differences() with the largest |z|, `most` at most, none beside another. Paths are not set.
std::vector<WorstPlace> worst_places(const PictureNoise& theirs, const PictureNoise& ours, std::size_t most);

}  // namespace neumann
