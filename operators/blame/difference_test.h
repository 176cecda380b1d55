// Whether two noisy pictures have the same expectation.
#pragma once

#include "core/image/image.h"

#include <vector>

namespace neumann {

struct PictureNoise {
    Image mean, variance;  // of the mean, by pixel and channel
};

// The variance of a picture's pixels from its own neighbourhoods, for pictures that come without: of a pixel less the mean of its
// four neighbours, median over 7×7 pixels. Edges do not count as long as most pixels around them are smooth.
Image local_variance(const Image& picture);

// How many times the variance a picture has of another one of the same light, whose errors are known: for independent samples, the
// ratio of their numbers. The smaller of what differences and neighbourhoods say, for most pixels; infinite where nothing is noisy.
double times_the_variance(const Image& picture, const PictureNoise& known);

// a less b with standard errors, which are at least 0.02% of the pictures' means, as of rounding.
Estimate difference_of(const PictureNoise& a, const PictureNoise& b);

// The mean of the difference over a block of 8×8 pixels, fewer at the edges, and the variance of that mean.
struct BlockDifference {
    int x = 0, y = 0, width = 0, height = 0;
    Rgb mean, variance;

    double pixels() const { return static_cast<double>(width) * height; }
};

struct DifferenceTest {
    double p = 1.0;            // of a difference at least so large by chance, for all channels and blocks together
    double ratio = 1.0;        // of the means, the first to the second
    double ratio_error = 0.0;  // standard error
};

// The variance of a block's difference is the larger one of its pixels' spread and what the pictures say; neighbouring pixels may
// be correlated, as those of wide pixel filters are. Differences below 0.02% of the mean do not count.
std::vector<BlockDifference> block_differences(const PictureNoise& a, const PictureNoise& b);

// Compares means over these blocks and over all pixels.
DifferenceTest test_difference(const PictureNoise& a, const PictureNoise& b);

// −2 log of the likelihood of a, given b, up to a constant: Student's t with 4 degrees of freedom in each pixel and channel, so
// that fireflies do not decide. Smaller is likelier; differences of 10 are strong evidence. `usual`: the variance of b by which
// densities are normalised: of pixels that are means of others the variance of these, so that less noise is no evidence.
double misfit(const PictureNoise& a, const PictureNoise& b, const Image& usual);
inline double misfit(const PictureNoise& a, const PictureNoise& b) { return misfit(a, b, b.variance); }

// By how much b is a likelier source of a than the other: the difference of χ², without what the noise of b and the other adds to
// it, where no pixel counts for more than 3, so that what few pixels say by chance does not decide.
double evidence_for(const PictureNoise& a, const PictureNoise& b, const PictureNoise& other);

}  // namespace neumann
