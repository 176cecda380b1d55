// Differences that fill few pixels, which blocks do not show: moved edges, lamps that are not seen. They are told by pixels whose
// light is sure, in that most samples bring it. Every right renderer has it there within its noise, which is as likely above as
// below.
#pragma once

#include "operators/experiments/blame/picture_noise.h"

namespace neumann {

struct SurePixels {
    double p = 1.0;     // of a difference that goes so well along with a mistake, by chance
    double left = 1.0;  // part of the squared difference that the mistake leaves
};

// A right picture from other paths than ours.
struct SureLight {
    const PictureNoise& picture;
    double samples;  // a pixel
};

// How many samples a pixel another renderer has at least: from what the camera sees of lamps, which is alike in all of them.
double fewest_samples(const PictureNoise& theirs, const PictureNoise& ours, const SureLight& right);

// Whether `theirs` less `ours` goes along with `wrong` less `right`, over pixels in which chance hardly does.
SurePixels test_sure_pixels(const PictureNoise& theirs, const PictureNoise& ours, const SureLight& right, const PictureNoise& wrong,
                            double their_samples);

// The same over all pixels, for what the camera sees of lamps: with x the product of `theirs` less `ours` and `wrong` less `right`,
// t = Σx / √Σx². If signs are as likely as not and independent, its tail is at most 3.18 times the normal one, whatever the sizes
// (Bentkus and Dzindzalieta 2015).
SurePixels test_signs(const PictureNoise& theirs, const PictureNoise& ours, const SureLight& right, const PictureNoise& wrong);

}  // namespace neumann
