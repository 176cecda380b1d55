#include "apps/output/sheets/labelled_picture.h"

#include "apps/output/sheets/mark.h"
#include "core/image/image_io.h"
#include "core/image/resize.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace neumann {

namespace {

constexpr int smallest_font = 6;

// Letters, of one to four bytes.
int letters_in(const std::string& text) {
    return static_cast<int>(std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; }));
}

// Letters of a line of this width: most take at most three fifths of the font's size.
int letters_a_line(int width, int font_size) { return std::max(1, 5 * width / (3 * font_size)); }

std::vector<std::string> wrapped(const std::string& text, int letters) {
    std::vector<std::string> lines(1);
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        if (!lines.back().empty() && letters_in(lines.back() + " " + word) > letters) lines.emplace_back();
        lines.back() += (lines.back().empty() ? "" : " ") + word;
    }
    return lines;
}

DisplayImage shown(const LabelledPicture& picture, int width, int height, double exposure, const SheetStyle& style) {
    if (!picture.picture) {
        DisplayImage out(width, height, style.theme.background);
        const auto [lines, size] = filling(picture.instead, width, height, explanation_size);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            const int top = static_cast<int>(i) * label_height(size);
            if (top + label_height(size) <= height)
                out.paste(caption(lines[i], width, label_height(size), size, style, false), 0, top);
        }
        return out;
    }
    const Image& all = *picture.picture;
    const DisplayImage pixels =
        to_display(resized(all, std::min(width, all.width), std::min(height, all.height)), exposure * picture.factor);
    DisplayImage out = enlarged(pixels, width / pixels.width);
    if (picture.mark) draw_mark(out, place_of_mark(picture, width, height));
    return out;
}

}  // namespace

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream all(text);
    for (std::string line; std::getline(all, line);) lines.push_back(line);
    return lines;
}

FilledLines filling(const std::string& text, int width, int height, int font_size) {
    const auto set_in = [&](int size) { return FilledLines{wrapped(text, letters_a_line(width, size)), size}; };
    FilledLines filled = set_in(font_size);
    while (filled.font_size > smallest_font && static_cast<int>(filled.lines.size()) * label_height(filled.font_size) > height)
        filled = set_in(filled.font_size - 1);
    return filled;
}

int fitting_size(const std::string& text, int width, int font_size) {
    return std::clamp(5 * width / (3 * std::max(1, letters_in(text))), smallest_font, font_size);
}

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
    while (taken > width && font_size > smallest_font) {
        font_size = std::max(smallest_font, std::min(font_size - 1, font_size * width / taken));
        taken = text_width(text, font_size, *font);
    }
    const int baseline = (height + 7 * font_size / 10) / 2;
    draw_text(strip, centred ? std::max(0, (width - taken) / 2) : 0, baseline, text, font_size, *font, theme.text);
    return strip;
}

DisplayImage with_label(const LabelledPicture& picture, int width, int height, double exposure, int label_size,
                        const SheetStyle& style) {
    const std::vector<std::string> lines = lines_of(picture.label);
    const int line = label_height(label_size);
    DisplayImage out(width, height + static_cast<int>(lines.size()) * line, style.theme.background);
    out.paste(shown(picture, width, height, exposure, style), 0, 0);
    for (std::size_t i = 0; i < lines.size(); ++i)
        out.paste(caption(lines[i], width, line, label_size, style, true), 0, height + static_cast<int>(i) * line);
    return out;
}

double scale_shown(int width, int height, double fitting) {
    if (fitting <= 1.0) return fitting;
    return std::floor(std::min(fitting, std::max(8.0, 128.0 / std::max(width, height))));
}

}  // namespace neumann
