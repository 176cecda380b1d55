#include "apps/output/sheets/mark.h"

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

// Fills the part of a rectangle that is in the picture; its right and lower sides are not part of it.
void fill(DisplayImage& picture, int left, int top, int right, int bottom, std::uint8_t grey) {
    for (int y = std::max(0, top); y < std::min(picture.height, bottom); ++y)
        for (int x = std::max(0, left); x < std::min(picture.width, right); ++x)
            std::fill_n(picture.bytes.begin() + 3 * (static_cast<std::ptrdiff_t>(y) * picture.width + x), 3, grey);
}

}  // namespace

PlaceOfMark place_of_mark(const LabelledPicture& picture, int width, int height) {
    const auto& [x, y] = *picture.mark;
    return {(x + 0.5) * width / picture.picture->width, (y + 0.5) * height / picture.picture->height};
}

void draw_mark(DisplayImage& picture, const PlaceOfMark& place) {
    const int x = static_cast<int>(std::lround(place.x)), y = static_cast<int>(std::lround(place.y));
    for (const auto& [beyond, grey] : {std::pair(mark_width / 2 + mark_edge, 0), std::pair(mark_width / 2, 255)})
        for (const auto& [x0, y0, x1, y1] : arms_of_mark) {
            const int edge = beyond - mark_width / 2, across = y0 == y1 ? 0 : beyond, down = y0 == y1 ? beyond : 0;
            fill(picture, x + x0 - std::max(across, edge), y + y0 - std::max(down, edge), x + x1 + std::max(across, edge),
                 y + y1 + std::max(down, edge), static_cast<std::uint8_t>(grey));
        }
}

}  // namespace neumann
