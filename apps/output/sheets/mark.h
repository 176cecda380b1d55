// A cross on a pixel of a picture, white with a black edge, so that it is seen on all of them; the pixel itself stays free.
#pragma once

#include "apps/output/sheets/labelled_picture.h"

#include <array>
#include <vector>

namespace neumann {

// The middle of the marked pixel in a picture that is shown `width` × `height` pixels large. The picture must have a mark.
struct PlaceOfMark {
    double x, y;
};
PlaceOfMark place_of_mark(const LabelledPicture& picture, int width, int height);

// The arms of the cross, each from a point to a point beside the middle: x0, y0, x1, y1.
constexpr std::array<std::array<int, 4>, 4> arms_of_mark{{{-14, 0, -5, 0}, {5, 0, 14, 0}, {0, -14, 0, -5}, {0, 5, 0, 14}}};
constexpr int mark_width = 2, mark_edge = 1;

void draw_mark(DisplayImage& picture, const PlaceOfMark& place);

}  // namespace neumann
