// Strips of pictures for slides: the terms K^i Le, the sums of the series, and the sums up to bounce 1, 2, 4, 8 and 16.
#pragma once

#include "apps/output/sheets/labelled_picture.h"
#include "operators/render/from_paths/mixture.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace neumann {

using Pictures = std::vector<LabelledPicture>;

// "", "K ", "K² ", …
std::string power_of(const std::string& K, std::size_t i);

// All pictures of a series, in scene-linear radiance, of one size; they must outlive this object.
struct SeriesPictures {
    std::span<const Image> terms, sums;  // for bounces 0 to N
    const Image* rest = nullptr;         // the sum of all later bounces and (`limit`) of all bounces, if they are known
    const Image* limit = nullptr;
    std::string K = "K", Le = "Le";  // or "K*", "We"
    std::string kind = {};           // appended to labels, such as ", some paths"

    // "Le", "K Le", "K² Le", …, "rest, beyond 6", "bounce 0", "bounces 0 to 1", …, "all bounces".
    Pictures all() const;
};

// Rows of pictures, one below the other; one that is shorter than others ends before them.
using Strip = std::vector<Pictures>;

// Bounces 0 to 6, as far as they exist. The row below shows each multiplied by its brightening(): "16 K³ Le".
Strip strip_of_terms(const SeriesPictures& series, const Image& emission, double exposure);
// The sums up to bounce 0, …, 6, as far as they exist.
Strip strip_of_sums(const SeriesPictures& series);
// The sums up to bounce 1, 2, 4, 8 and 16. If the series ends before, its limit follows. May be empty.
Strip strip_of_doubling(const SeriesPictures& series);

// For each method of a mixture a row with its weights in bounces 0 to 6, as far as they exist, from 0 (black) to 1 (white): a pixel
// is a block of the picture. The pictures are kept in `maps`.
Strip strip_of_mixture(const Mixture& mixture, std::vector<Image>& maps);

constexpr int largest_picture = 480, strip_label_size = 20;

// The places of pictures of `width` × `height` in a strip, each with its label of so many lines below.
struct StripLayout {
    int border, rows, columns, width, height, lines;

    int left(int column) const { return border + column * (width + sheet_gap); }
    int top(int row) const { return border + row * (height + lines * label_height(strip_label_size)); }
    int whole_width() const { return left(columns) - sheet_gap + border; }
    int whole_height() const { return top(rows) + border; }
};
// The lines of a text below a strip, as long as it is wide, and their height.
std::vector<std::string> lines_below(const std::string& below, const StripLayout& at);
constexpr int height_below(std::size_t lines) {
    return lines == 0 ? 0 : sheet_gap + static_cast<int>(lines) * label_height(explanation_size);
}
StripLayout layout_strip(const Strip& strip, int border = sheet_margin, double largest_scale = largest_picture);

// A PNG file, at most 1920 pixels wide. Small pictures are enlarged by whole factors. At least one picture must be there.
// The file carries the comment, and below the pictures are the lines of `below`, unless they are empty.
std::string strip_png(const Strip& strip, double exposure, const SheetStyle& style, const std::string& comment = "",
                      const std::string& below = "");
// A GIF file: each frame is a column of the strip, with its pictures side by side.
std::string strip_gif(const Strip& strip, double exposure, const SheetStyle& style);

}  // namespace neumann
