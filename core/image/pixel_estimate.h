// A picture with errors that hold for single pixels.
#pragma once

#include "core/image/image.h"

#include <utility>

namespace neumann {

struct PixelEstimate : Estimate {
    // The error that few samples leave open in a pixel however well they agree, ≥ 0; empty if there is none.
    Image least_error = {};

    PixelEstimate() = default;
    PixelEstimate(Estimate estimate) : Estimate(std::move(estimate)) {}

    // The standard errors for the intervals of single pixels: those of the samples' spread, and not below
    // `least_error`. Means over pixels use the spread alone, `standard_error`.
    Image pixel_errors() const {
        Image errors = standard_error;
        for (std::size_t i = 0; i < errors.pixels.size() && i < least_error.pixels.size(); ++i)
            errors.pixels[i] = glm::max(errors.pixels[i], least_error.pixels[i]);
        return errors;
    }
};

}  // namespace neumann
