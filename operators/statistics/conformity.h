// Whether a picture agrees with a reference that another program sampled, as Mitsuba's regression tests judge it and as its own
// standard errors do. Colours are XYZ.
#pragma once

#include "core/image/image.h"

#include <cstdint>

namespace neumann {

struct SampledReference {
    Image mean, variance;   // of single samples; not negative but for rounding
    std::uint64_t samples;  // a pixel
};

// Each channel of each pixel is tested by itself, two-sided, at a level such that a perfect picture has one rejection with
// probability 1% (Šidák 1967, over the pixels); the picture is accepted where at least 99.75% of them are.
struct Conformity {
    double accepted = 0.0;  // part of the pixels' channels
    Image p_values;
    bool conforms() const { return accepted >= 0.9975; }
};

// Mitsuba's own criterion: the difference over √(reference variance / samples), the variance at least 1e-4; normal. It knows no
// error of the reference. Throws InputError where the sizes differ.
Conformity conformity_by_reference(const Image& picture, std::uint64_t samples, const SampledReference& reference);

// The difference over √(SE² + reference variance / reference samples + rounding²), by Student's t. SE is at least what the reference's
// variance gives for as many samples. The rounding is that of floats that were added up, systematic where all are alike, and of half
// floats, in which Mitsuba stores films, and so their variance, unless told otherwise: the references of its scenes directional, spot
// and texture_interp are half floats to the last bit, once they are XYZ again. Throws InputError where the sizes differ.
Conformity conformity_by_error(const Estimate& picture, const SampledReference& reference);

}  // namespace neumann
