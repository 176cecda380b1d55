// Animated GIFs of the pictures of a series.
#pragma once

#include "apps/output/sheets/labelled_picture.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace neumann {

// Each picture is compressed once, even if it is part of several GIFs.
class FlipBook {
public:
    // Takes at least one picture, all of one size and at one exposure. They are shown at most 512 pixels long, or smaller if there
    // are so many that compression would take long; small ones are enlarged by whole factors. Without a font (find_label_font)
    // there are no labels.
    FlipBook(std::vector<LabelledPicture> pictures, double exposure, const SheetStyle& style);

    // A GIF file of all pictures, or of the chosen ones: an endless loop with three pictures in two seconds.
    std::string gif(std::span<const LabelledPicture> chosen) const;
    std::string gif() const { return gif(pictures_); }

private:
    std::vector<LabelledPicture> pictures_;
    std::vector<std::string> pages_;
};

// The same for frames of one size, at least one.
std::string flip_book(std::span<const DisplayImage> frames);

// The scale at which `pictures` pictures of this size compress within `seconds`.
double affordable_scale(int width, int height, std::size_t pictures, double seconds);

}  // namespace neumann
