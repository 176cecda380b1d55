// A picture with its name, as the contact sheet and the flip-book show it.
#pragma once

#include "core/image/display.h"

#include <optional>
#include <string>

namespace neumann {

// `picture` is in scene-linear radiance and outlives this.
struct LabelledPicture {
    std::string label;
    const Image* picture = nullptr;
};

// A strip of `width` × `height` pixels with a text on it, centred or at the left; empty without a font. A text that is too wide is
// set smaller.
DisplayImage caption(const std::string& text, int width, int height, int font_size, const std::optional<std::string>& font,
                     bool centred, std::uint8_t background);

}  // namespace neumann
