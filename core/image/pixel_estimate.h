// A picture whose pixels are to be believed one by one.
#pragma once

#include "core/image/image.h"

#include <utility>

namespace neumann {

struct PixelEstimate : Estimate {
    Image least_error = {};  // ≥ 0: what few samples leave open in a pixel however well they agree; empty: nothing

    PixelEstimate() = default;
    PixelEstimate(Estimate estimate) : Estimate(std::move(estimate)) {}

    // The standard errors by which a pixel's interval holds the truth: of the samples' spread, and not below `least_error`. Means
    // over pixels have the spread alone, `standard_error`.
    Image pixel_errors() const {
        Image errors = standard_error;
        for (std::size_t i = 0; i < errors.pixels.size() && i < least_error.pixels.size(); ++i)
            errors.pixels[i] = glm::max(errors.pixels[i], least_error.pixels[i]);
        return errors;
    }
};

}  // namespace neumann
