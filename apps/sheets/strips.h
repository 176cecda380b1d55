// Strips of pictures for slides: the terms K^i Le, the sums of the series, and the sums up to bounce 1, 2, 4, 8 and 16.
#pragma once

#include "apps/sheets/labelled_picture.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace neumann {

using Pictures = std::vector<LabelledPicture>;

// All pictures of a series, in scene-linear radiance, of one size; they outlive this.
struct SeriesPictures {
    std::span<const Image> terms, sums;  // of bounces 0 to N
    const Image* rest = nullptr;         // of all others, and the sum of all, where they are known
    const Image* limit = nullptr;
    std::string K = "K", Le = "Le";  // or "K*", "We"
    std::string kind = {};           // ", some paths", where labels say so

    // "Le", "K Le", "K^2 Le", …, "rest, beyond 6", "bounce 0", "bounces 0 to 1", …, "all bounces".
    Pictures all() const;
};

// Rows of as many pictures, below one another.
using Strip = std::vector<Pictures>;

// Bounces 0 to 6, as far as there are any; below each times the largest power of two, at least 1, at which the 99th percentile
// of its luminance is no brighter than white at this exposure: "16 K^3 Le". Pixels where `emission` is not black do not vote
// (exposure_for).
Strip strip_of_terms(const SeriesPictures& series, const Image& emission, double exposure);
// The sums up to bounce 0 to 6, likewise.
Strip strip_of_sums(const SeriesPictures& series);
// Up to bounce 1, 2, 4, 8 and 16; where the series ends before, its limit follows. May be empty.
Strip strip_of_doubling(const SeriesPictures& series);

// A PNG file, at most 1920 pixels wide. Small pictures are enlarged by whole factors. The strip is not empty.
std::string strip_png(const Strip& strip, double exposure, const std::optional<std::string>& font);
// A GIF file: column after column, the pictures of each beside one another.
std::string strip_gif(const Strip& strip, double exposure, const std::optional<std::string>& font);

}  // namespace neumann
