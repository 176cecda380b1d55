// The terms of a series, then its sums, as an animated GIF.
#pragma once

#include "apps/labelled_picture.h"

#include <optional>
#include <span>
#include <string>

namespace neumann {

// A GIF file, endless, three frames in two seconds, at one exposure. Pictures are at most 512 pixels long, fewer where there are so
// many that compressing them would take long; small ones are enlarged by whole factors. All are of one size; at least one. Without
// a font (find_label_font) the frames have no labels.
std::string flip_book(std::span<const LabelledPicture> terms, std::span<const LabelledPicture> sums, double exposure,
                      const std::optional<std::string>& font);

}  // namespace neumann
