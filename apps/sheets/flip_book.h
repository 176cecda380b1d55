// Pictures of a series one after another, as animated GIFs.
#pragma once

#include "apps/sheets/labelled_picture.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace neumann {

// Pictures are compressed once, whatever books they are in.
class FlipBook {
public:
    // At least one picture, all of one size and at one exposure; they are shown at most 512 pixels long, fewer where there are so
    // many that compressing them would take long, and small ones are enlarged by whole factors. Without a font (find_label_font)
    // they have no labels.
    FlipBook(std::vector<LabelledPicture> pictures, double exposure, const std::optional<std::string>& font);

    // A GIF file of these of its pictures, or of all: endless, three in two seconds.
    std::string gif(std::span<const LabelledPicture> chosen) const;
    std::string gif() const { return gif(pictures_); }

private:
    std::vector<LabelledPicture> pictures_;
    std::vector<std::string> pages_;
};

// A GIF file of frames of one size, likewise; at least one.
std::string flip_book(std::span<const DisplayImage> frames);

// The scale at which `pictures` of this size compress within the time that a render can spare.
double affordable_scale(int width, int height, std::size_t pictures, double seconds);

}  // namespace neumann
