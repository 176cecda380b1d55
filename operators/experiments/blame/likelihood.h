// The likelihood of a picture, given another with its noise.
#pragma once

#include "operators/experiments/blame/picture_noise.h"

namespace neumann {

// −2 log of the likelihood of a, given b, up to a constant: Student's t with 4 degrees of freedom in each pixel and
// channel, so that fireflies do not decide. Smaller is likelier; differences of 10 are strong evidence. `usual`: the
// variance of b by which densities are normalised. For pixels that are means of others, it is the variance of these
// others, so that less noise is no evidence.
double misfit(const PictureNoise& a, const PictureNoise& b, const Image& usual);
inline double misfit(const PictureNoise& a, const PictureNoise& b) { return misfit(a, b, b.variance); }

}  // namespace neumann
