// Tests whether the pixels of a picture may have shared random numbers. They then err together, over wide areas and with one sign,
// and one picture cannot distinguish such an error from a mistake: its own noise, between neighbours, is much smaller.
#pragma once

#include "operators/experiments/blame/picture_noise.h"

namespace neumann {

// The squared difference of a block in units of the variance of its pixels, estimated from neighbours, for most blocks:
// 0.007 if numbers are independent and our samples are many more.
double smooth_part(const PictureNoise& theirs, const PictureNoise& ours);
constexpr double most_if_independent = 0.02;

}  // namespace neumann
