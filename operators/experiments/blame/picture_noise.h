// A noisy picture, and its known noise.
#pragma once

#include "core/image/image.h"

namespace neumann {

struct PictureNoise {
    Image mean, variance;  // of the mean, by pixel and channel
};

// The mean of a channel over pixels.
double mean_of(const Image& image, int channel);

// Differences below this part of a picture's mean count as rounding errors.
constexpr double rounding_of_pictures = 2e-4;

// An estimate of the variance of a picture's pixels, for pictures without a variance: from the difference of a pixel and the mean
// of its four neighbours, the median over 7×7 pixels. Edges do not count as long as most pixels around them are smooth.
Image local_variance(const Image& picture);

// The same for theirs with the help of ours: the details of the scene are not in the difference of both, but our noise
// is, so the smaller estimate of both is taken.
Image noise_of_neighbours(const PictureNoise& theirs, const PictureNoise& ours);

// The ratio of a picture's variance to that of another one of the same light, whose errors are known: for independent
// samples, the ratio of their numbers. Takes the smaller of the estimates from differences and from neighbourhoods, for
// most pixels; infinite if nothing is noisy.
double times_the_variance(const Image& picture, const PictureNoise& known);

// a less b with standard errors, which are at least 0.02% of the pictures' means, because of rounding.
Estimate difference_of(const PictureNoise& a, const PictureNoise& b);

}  // namespace neumann
