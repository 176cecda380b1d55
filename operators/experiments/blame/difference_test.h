// Tests whether two noisy pictures have the same expectation.
#pragma once

#include "operators/experiments/blame/picture_noise.h"

#include <vector>

namespace neumann {

// The mean of the difference over a block of 8×8 pixels, fewer at the edges.
struct BlockDifference {
    int x = 0, y = 0, width = 0, height = 0;
    Rgb mean{0.0};
    Rgb noise{0.0};     // variance of that mean, estimated from this block
    Rgb variance{0.0};  // the same, from its neighbours if that is more
    Rgb freedom{0.0};   // degrees of freedom of Student's t for the mean in units of √variance

    double pixels() const { return static_cast<double>(width) * height; }
};
struct BlockDifferences {
    std::vector<BlockDifference> blocks;
    Rgb freedom{0.0};  // the same for the mean over all blocks
};

struct DifferenceTest {
    double p = 1.0;            // the probability of a difference so large, for all channels and blocks together
    double ratio = 1.0;        // mean of the first picture divided by that of the second
    double ratio_error = 0.0;  // standard error
};

// The differences of means over blocks. The noise of a block is the larger of its pixels' spread and the pictures' own
// variance. In a block that rare bright samples have missed the noise is hidden, so its variance is at least that of
// the 3×3 blocks around it, in units of their light. Neighbouring pixels may be correlated, as they are with wide pixel
// filters. Differences below 0.02% of the mean do not count.
BlockDifferences block_differences(const PictureNoise& a, const PictureNoise& b);

// Compares means over these blocks and over all pixels.
DifferenceTest test_difference(const PictureNoise& a, const PictureNoise& b);

}  // namespace neumann
