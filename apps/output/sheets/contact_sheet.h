// All bounces and all sums of a series on one sheet, at one exposure.
#pragma once

#include "apps/output/sheets/labelled_picture.h"

#include <optional>
#include <span>
#include <string>

namespace neumann {

// A grid of `columns` thumbnails for two blocks of pictures, the terms above the sums.
struct SheetLayout {
    int columns = 0, term_rows = 0, sum_rows = 0;
    int thumbnail_width = 0, thumbnail_height = 0;
};

struct SheetHeadings {
    std::string terms = "bounces", sums = "sums";
    std::string comment = {};  // a comment in the file, unless it is empty
};

// The layout with the largest thumbnails on a sheet of at most about 2400×2400 pixels, for pictures of `width` × `height` pixels.
// Small pictures are enlarged by whole factors.
SheetLayout layout_sheet(int terms, int sums, int width, int height);

// A PNG file of the sheet: `terms` (at least one; "bounce 0", …, "rest"), then `sums` ("sum 0", "sum 0..1", …), all of one size and
// multiplied by `exposure`, which is printed on the sheet. Without a font (find_label_font) the sheet has no labels.
std::string contact_sheet(std::span<const LabelledPicture> terms, std::span<const LabelledPicture> sums, double exposure,
                          const SheetStyle& style, const SheetHeadings& headings = {});

}  // namespace neumann
