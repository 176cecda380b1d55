#include "apps/sheets/labelled_picture.h"

#include "core/image/image_io.h"
#include "core/image/resize.h"

#include <algorithm>
#include <cmath>

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

DisplayImage with_label(const LabelledPicture& picture, int width, int height, double exposure, int label_size,
                        const std::optional<std::string>& font) {
    DisplayImage out(width, height + label_height(label_size), sheet_background);
    const Image& all = *picture.picture;
    const DisplayImage pixels =
        to_display(resized(all, std::min(width, all.width), std::min(height, all.height)), exposure * picture.factor);
    out.paste(enlarged(pixels, width / pixels.width), 0, 0);
    out.paste(caption(picture.label, width, label_height(label_size), label_size, font, true), 0, height);
    return out;
}

double scale_shown(int width, int height, double fitting) {
    if (fitting <= 1.0) return fitting;
    return std::floor(std::min(fitting, std::max(8.0, 128.0 / std::max(width, height))));
}

}  // namespace neumann
