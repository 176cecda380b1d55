// Strips as drawings for papers: pictures in pixels, labels as text.
#pragma once

#include "apps/output/sheets/strips.h"

namespace neumann {

// An SVG file with the layout of strip_png(), which holds its pictures as PNG, a pixel for a pixel, or smaller where they are shown
// smaller. The strip must not be empty. The file carries the comment as its description, unless that is empty.
std::string strip_svg(const Strip& strip, double exposure, SheetTheme theme, const std::string& comment = "");

}  // namespace neumann
