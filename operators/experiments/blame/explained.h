// Measures how much of a difference a mistake explains.
#pragma once

#include "operators/experiments/blame/picture_noise.h"

namespace neumann {

// The difference of theirs less ours.
class Explained {
public:
    Explained(const PictureNoise& theirs, const PictureNoise& ours);

    // The part of the squared difference, beyond noise, that disappears if ours are replaced by `wrong`: 1 all of it, 0
    // none; also 0 if noise hides the amount. The larger value of blocks and pixels is taken: pixels show smooth
    // differences, and blocks those that are below the noise of pixels.
    double by(const PictureNoise& wrong) const;

private:
    double by_blocks(const PictureNoise& wrong) const;
    double by_pixels(const PictureNoise& wrong) const;
    double beyond_noise(const PictureNoise& expected) const;

    const PictureNoise &theirs_, &ours_;
    Image noise_;  // variance of theirs, estimated from neighbours
};

}  // namespace neumann
