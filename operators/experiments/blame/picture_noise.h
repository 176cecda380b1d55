// A noisy picture, and what is known of its noise.
#pragma once

#include "core/image/image.h"

namespace neumann {

struct PictureNoise {
    Image mean, variance;  // of the mean, by pixel and channel
};

// Over pixels.
double mean_of(const Image& image, int channel);

// Differences below this part of a picture's mean do not count, as those of rounding.
constexpr double rounding_of_pictures = 2e-4;

// The variance of a picture's pixels from its own neighbourhoods, for pictures that come without: of a pixel less the mean of its
// four neighbours, median over 7×7 pixels. Edges do not count as long as most pixels around them are smooth.
Image local_variance(const Image& picture);

// The same of theirs beside ours: what is in the scene, and no noise, is not in their difference. That has our noise besides, so
// that the less of both is taken.
Image noise_of_neighbours(const PictureNoise& theirs, const PictureNoise& ours);

// How many times the variance a picture has of another one of the same light, whose errors are known: for independent samples, the
// ratio of their numbers. The smaller of what differences and neighbourhoods say, for most pixels; infinite where nothing is noisy.
double times_the_variance(const Image& picture, const PictureNoise& known);

// a less b with standard errors, which are at least 0.02% of the pictures' means, as of rounding.
Estimate difference_of(const PictureNoise& a, const PictureNoise& b);

}  // namespace neumann
