// Pictures of fewer pixels, for the search among mistakes: their number is then bounded, and with it memory and time, while all
// light is still there.
#pragma once

#include "operators/experiments/blame/picture_mistakes.h"

#include <cstdint>
#include <vector>

namespace neumann {

// Each pixel of the result is the mean over factor × factor pixels, or of those that there are at the right and lower edges. Pixels
// are independent.
PictureNoise joined(const PictureNoise& picture, int factor);
ComparedTerm joined(const ComparedTerm& term, int factor);
// What is at the middle of each joined pixel; `values` are of a picture of this width.
std::vector<std::uint32_t> at_middles(const std::vector<std::uint32_t>& values, int width, int factor);

// The factor for a picture of this size: 1 up to 128 × 128.
int joining_factor(int width, int height);

}  // namespace neumann
