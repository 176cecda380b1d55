// Converts scene-linear radiance to the bytes that a screen shows.
#pragma once

#include "core/image/image.h"

#include <cstdint>
#include <vector>

namespace neumann {

// An sRGB picture, three bytes a pixel, row 0 at the top.
struct DisplayImage {
    int width = 0, height = 0;
    std::vector<std::uint8_t> bytes;

    DisplayImage() = default;
    DisplayImage(int w, int h, std::uint8_t grey)
        : width(w), height(h), bytes(3 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h), grey) {}

    // Copies `picture` so that its top left corner is at (x, y); throws std::out_of_range unless it fits.
    void paste(const DisplayImage& picture, int x, int y);
};

// Luminance of linear Rec. 709 / sRGB primaries.
double luminance(const Rgb& c);

// The factor that brings the 99th percentile of the luminance to white (1). Pixels in which an emitter is seen directly
// (`emission` not black) and pixels that are black or not finite do not count; if only emitters are left, they do. 1
// for an all-black picture. `emission` has the size of `sum`; otherwise throws std::invalid_argument.
double exposure_for(const Image& sum, const Image& emission);

// Each value times `exposure`, clipped to 0..1, in the sRGB transfer function. A pixel that is not finite becomes magenta.
DisplayImage to_display(const Image& picture, double exposure);

}  // namespace neumann
