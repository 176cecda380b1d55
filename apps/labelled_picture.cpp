#include "apps/labelled_picture.h"

#include "core/image/image_io.h"

#include <algorithm>

namespace neumann {

DisplayImage caption(const std::string& text, int width, int height, int font_size, const std::optional<std::string>& font,
                     bool centred, std::uint8_t background) {
    DisplayImage strip(width, height, background);
    if (!font) return strip;
    int taken = text_width(text, font_size, *font);
    if (taken > width) {
        font_size = std::max(6, font_size * width / taken);
        taken = text_width(text, font_size, *font);
    }
    const int baseline = (height + 7 * font_size / 10) / 2;
    draw_text(strip, centred ? std::max(0, (width - taken) / 2) : 0, baseline, text, font_size, *font, 230);
    return strip;
}

}  // namespace neumann
