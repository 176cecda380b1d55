// Tests differences that fill few pixels, which blocks do not show: moved edges, lamps that are not seen. They show in
// pixels whose light is sure, because most samples bring it. Every right renderer has this light within its noise,
// which is as likely above as below.
#pragma once

#include "operators/experiments/blame/picture_noise.h"

namespace neumann {

struct SurePixels {
    double p = 1.0;     // the probability that a difference agrees so well with a mistake by chance
    double left = 1.0;  // the part of the squared difference that the mistake leaves
};

// A right picture from other paths than ours.
struct SureLight {
    const PictureNoise& picture;
    double samples;  // of a pixel
};

// The least number of samples a pixel of another renderer, from the lamps that the camera sees, as all sample them alike.
double fewest_samples(const PictureNoise& theirs, const PictureNoise& ours, const SureLight& right);

// Tests whether `theirs` less `ours` agrees with `wrong` less `right`, over pixels in which it hardly does by chance.
SurePixels test_sure_pixels(const PictureNoise& theirs, const PictureNoise& ours, const SureLight& right, const PictureNoise& wrong,
                            double their_samples);

// The same over all pixels, for lamps that the camera sees: with x the product of `theirs` less `ours` and `wrong` less
// `right`, t = Σx / √Σx². If both signs are equally likely and independent, its tail is at most 3.18 times the normal
// one, whatever the sizes (Bentkus and Dzindzalieta 2015).
SurePixels test_signs(const PictureNoise& theirs, const PictureNoise& ours, const SureLight& right, const PictureNoise& wrong);

}  // namespace neumann
