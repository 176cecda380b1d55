#include "apps/output/sheets/labelled_picture.h"

#include "core/image/image_io.h"
#include "core/image/resize.h"

#include <algorithm>
#include <cmath>

namespace neumann {

double brightening(const Image& term, const Image& emission, double exposure) {
    // Rounding down to a power of two keeps the term from being too bright; 1e-3 allows for the rounding of pixel values.
    const double factor = std::exp2(std::floor(std::log2(exposure_for(term, emission) / exposure) + 1e-3));
    const bool black = std::all_of(term.pixels.begin(), term.pixels.end(), [](const Rgb& p) { return is_black(p); });
    return black ? 1.0 : std::max(1.0, factor);
}

DisplayImage caption(const std::string& text, int width, int height, int font_size, const SheetStyle& style, bool centred) {
    const auto& [font, theme] = style;
    DisplayImage strip(width, height, theme.background);
    if (!font) return strip;
    int taken = text_width(text, font_size, *font);
    if (taken > width) {
        font_size = std::max(6, font_size * width / taken);
        taken = text_width(text, font_size, *font);
    }
    const int baseline = (height + 7 * font_size / 10) / 2;
    draw_text(strip, centred ? std::max(0, (width - taken) / 2) : 0, baseline, text, font_size, *font, theme.text);
    return strip;
}

DisplayImage with_label(const LabelledPicture& picture, int width, int height, double exposure, int label_size,
                        const SheetStyle& style) {
    DisplayImage out(width, height + label_height(label_size), style.theme.background);
    const Image& all = *picture.picture;
    const DisplayImage pixels =
        to_display(resized(all, std::min(width, all.width), std::min(height, all.height)), exposure * picture.factor);
    out.paste(enlarged(pixels, width / pixels.width), 0, 0);
    out.paste(caption(picture.label, width, label_height(label_size), label_size, style, true), 0, height);
    return out;
}

double scale_shown(int width, int height, double fitting) {
    if (fitting <= 1.0) return fitting;
    return std::floor(std::min(fitting, std::max(8.0, 128.0 / std::max(width, height))));
}

}  // namespace neumann
