// A picture with a label, for the contact sheet, the strips and the flip-book.
#pragma once

#include "core/image/display.h"

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace neumann {

// Margin around all pictures of a sheet, and gap between two of them, in pixels.
inline constexpr int sheet_margin = 24, sheet_gap = 12;

// Grey levels of a sheet.
struct SheetTheme {
    std::uint8_t background, text;
};
constexpr SheetTheme dark_theme{34, 230}, white_theme{255, 20};

struct SheetStyle {
    std::optional<std::string> font;  // find_label_font(); without one there are no labels
    SheetTheme theme = dark_theme;

    SheetStyle(std::optional<std::string> label_font, SheetTheme of = dark_theme) : font(std::move(label_font)), theme(of) {}
    SheetStyle(std::nullopt_t) {}
};

// `picture` is in scene-linear radiance and must outlive this object.
struct LabelledPicture {
    std::string label;  // may have several lines
    const Image* picture = nullptr;
    double factor = 1.0;                       // extra brightness factor, relative to the other pictures
    std::optional<std::array<int, 2>> mark{};  // a pixel that a cross is put on
    std::string instead{};                     // the text in place of a picture that is not there
};

// The largest power of two, at least 1, for which the 99th percentile of a term's luminance is at most white at this exposure.
// Pixels where `emission` is not black are ignored (exposure_for).
double brightening(const Image& term, const Image& emission, double exposure);

// An image of `width` × `height` pixels with a text, centred or at the left; without a font it is blank. A text that is too wide is
// set in a smaller size.
DisplayImage caption(const std::string& text, int width, int height, int font_size, const SheetStyle& style, bool centred);

// The picture, multiplied by `exposure` and its factor and scaled to `width` × `height` pixels (smaller, or larger by a whole
// factor), with its mark and with its label below, label_height(label_size) high a line.
DisplayImage with_label(const LabelledPicture& picture, int width, int height, double exposure, int label_size,
                        const SheetStyle& style);
// The size of texts that are no labels of pictures.
inline constexpr int explanation_size = 16;
constexpr int label_height(int label_size) { return 5 * label_size / 3; }

std::vector<std::string> lines_of(const std::string& text);

// A text in lines that fill `width` × `height` pixels, in the largest size, up to `font_size`, in which they fit.
struct FilledLines {
    std::vector<std::string> lines;
    int font_size = 0;
};
FilledLines filling(const std::string& text, int width, int height, int font_size);
// The size, up to `font_size`, in which a text is not wider than `width` with letters that are as wide as most.
int fitting_size(const std::string& text, int width, int font_size);

// The scale for pictures of this size if the scale `fitting` fits. Small pictures are enlarged up to eight times or to
// 128 pixels, whichever is larger, by whole factors, so that pixels stay square and equal.
double scale_shown(int width, int height, double fitting);

}  // namespace neumann
