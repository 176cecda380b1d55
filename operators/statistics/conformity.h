// Tests whether a picture agrees with a reference that another program sampled: with the criterion of Mitsuba's
// regression tests, and with the picture's own standard errors. Colours are XYZ.
#pragma once

#include "core/image/image.h"

#include <cstdint>

namespace neumann {

struct SampledReference {
    Image mean, variance;   // mean and variance of single samples; the variance is not negative, up to rounding
    std::uint64_t samples;  // per pixel
};

// Each channel of each pixel has a two-sided test, at a level such that a correct picture has any rejection with probability 1%
// (Šidák 1967, over the pixels). The picture is accepted if at least 99.75% of the tests are.
struct Conformity {
    double accepted = 0.0;  // accepted fraction of the channels of all pixels
    Image p_values;
    bool conforms() const { return accepted >= 0.9975; }
};

// Mitsuba's own criterion: z = difference / √(reference variance / samples), with a variance of at least 1e-4, is
// normally distributed. It ignores the error of the reference. Throws InputError if the sizes differ.
Conformity conformity_by_reference(const Image& picture, std::uint64_t samples, const SampledReference& reference);

// z = difference / √(SE² + reference variance / reference samples + rounding²) has Student's distribution. SE is at
// least what the reference's variance gives for the same number of samples. The rounding has two parts: floats that
// were added up (systematic if all samples are alike), and half floats, in which Mitsuba stores films and their
// variance by default (the references of its scenes directional, spot and texture_interp are exactly half floats after
// conversion back to XYZ). Throws InputError if the sizes differ.
Conformity conformity_by_error(const Estimate& picture, const SampledReference& reference);

// The picture's mean Y divided by the reference's.
double brightness(const Image& picture, const Image& reference);

}  // namespace neumann
