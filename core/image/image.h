// A picture in memory: linear RGB, row 0 at the top.
#pragma once

#include "core/base/vec.h"

#include <cstddef>
#include <vector>

namespace neumann {

struct Image {
    int width = 0, height = 0;
    std::vector<Rgb> pixels;

    Image() = default;
    Image(int w, int h) : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), Rgb(0.0)) {}

    Rgb& at(int x, int y) {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
    const Rgb& at(int x, int y) const {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
};

// A picture with the standard error of each pixel and channel, and the degrees of freedom of Student's t for its intervals. With a
// single replicate there are none, and the error is unknown: infinite.
struct Estimate {
    Image mean, standard_error;
    double degrees_of_freedom = 0.0;
    // How far the mean is estimated to be from the truth whatever the samples, ≥ 0; empty if not at all.
    Image discretisation = {};
    bool pixels_are_independent = true;
};

}  // namespace neumann
