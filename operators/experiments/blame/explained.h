// How much of a difference a mistake explains.
#pragma once

#include "operators/experiments/blame/picture_noise.h"

namespace neumann {

// Of theirs less ours.
class Explained {
public:
    Explained(const PictureNoise& theirs, const PictureNoise& ours);

    // Which part of the squared difference, beyond noise, goes if ours are made `wrong`: 1 all of it, 0 none; also 0 where noise
    // hides how much there is. By blocks or by pixels, whichever says more: pixels tell smooth differences, and blocks those
    // that are below the noise of pixels.
    double by(const PictureNoise& wrong) const;

private:
    double by_blocks(const PictureNoise& wrong) const;
    double by_pixels(const PictureNoise& wrong) const;
    double beyond_noise(const PictureNoise& expected) const;

    const PictureNoise &theirs_, &ours_;
    Image noise_;  // variance of theirs, as neighbours tell it
};

}  // namespace neumann
