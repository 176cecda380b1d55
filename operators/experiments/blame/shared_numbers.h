// Whether the pixels of a picture may have shared random numbers. They then err together, over wide areas and with one sign, and
// one picture cannot tell such an error from a mistake: its own noise, between neighbours, is much smaller.
#pragma once

#include "operators/experiments/blame/picture_noise.h"

namespace neumann {

// The squared difference of a block in units of the variance of their pixels, as neighbours tell it, for most blocks: 0.007
// if numbers are independent and ours are many more.
double smooth_part(const PictureNoise& theirs, const PictureNoise& ours);
constexpr double most_if_independent = 0.02;

}  // namespace neumann
