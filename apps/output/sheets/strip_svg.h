// Strips as drawings for papers: pictures as pixels, labels as text.
#pragma once

#include "apps/output/sheets/strips.h"

namespace neumann {

// An SVG file with the layout of strip_png(). It holds the pictures as PNG, pixel for pixel, or smaller if they are
// shown smaller. At least one picture must be there. The comment is the file's description.
std::string strip_svg(const Strip& strip, double exposure, SheetTheme theme, const std::string& comment = "",
                      const std::string& below = "");

}  // namespace neumann
