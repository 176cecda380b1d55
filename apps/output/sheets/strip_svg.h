// Strips as drawings for papers: pictures as pixels, labels as text.
#pragma once

#include "apps/output/sheets/strips.h"

namespace neumann {

// An SVG file with the layout of strip_png(). It holds the pictures as PNG, pixel for pixel, or smaller if they are
// shown smaller. The strip must not be empty. The file carries the comment as its description, unless that is empty.
std::string strip_svg(const Strip& strip, double exposure, SheetTheme theme, const std::string& comment = "");

}  // namespace neumann
