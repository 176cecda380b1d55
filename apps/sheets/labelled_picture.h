// A picture with its name, as the contact sheet, the strips and the flip-book show it.
#pragma once

#include "core/image/display.h"

#include <optional>
#include <string>

namespace neumann {

// Of sheets with several pictures, pixels: around all of them, and between two.
inline constexpr int sheet_margin = 24, sheet_gap = 12;

constexpr std::uint8_t sheet_background = 34;

// `picture` is in scene-linear radiance and outlives this.
struct LabelledPicture {
    std::string label;
    const Image* picture = nullptr;
    double factor = 1.0;  // by which it is brighter than those beside it
};

// A strip of `width` × `height` pixels with a text on it, centred or at the left; empty without a font. A text that is too wide is
// set smaller.
DisplayImage caption(const std::string& text, int width, int height, int font_size, const std::optional<std::string>& font,
                     bool centred, std::uint8_t background = sheet_background);

// The picture, times `exposure` and its factor, at `width` × `height` pixels, smaller than it is or by a whole factor larger, and
// its label below, label_height(label_size) high.
DisplayImage with_label(const LabelledPicture& picture, int width, int height, double exposure, int label_size,
                        const std::optional<std::string>& font);
constexpr int label_height(int label_size) { return 5 * label_size / 3; }

// At which scale pictures of this size are shown where there is room for `fitting`. Small ones grow until they are easily seen,
// eight times or to 128 pixels, and by whole factors, so that pixels stay square and equal.
double scale_shown(int width, int height, double fitting);

}  // namespace neumann
