// A drawing of lines, areas and text, for papers. Lengths are in points of 1/72 inch, x to the right and y downwards.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace neumann {

struct DrawnPoint {
    double x, y;
};

using Ink = std::array<std::uint8_t, 3>;  // sRGB

struct DrawnPath {
    std::vector<DrawnPoint> points;
    Ink ink{};
    double width = 0.5;         // of the line; 0: the area inside is filled
    std::vector<int> dashes{};  // lengths of strokes and gaps; none: a solid line
};

struct DrawnText {
    std::string text;     // UTF-8
    DrawnPoint at;        // on the baseline, at the text's left side, middle or right side
    double anchor = 0.0;  // 0, ½ or 1
    double size = 8.0;
    bool upwards = false;  // turned by 90° to the left about `at`
};

struct DrawnGroup {
    std::string name;  // what it shows; may be empty
    std::vector<DrawnPath> paths{};
    std::vector<DrawnText> texts{};
};

struct Drawing {
    double width, height;
    std::vector<DrawnGroup> groups{};
};

// A PDF file of one page with embedded letters of the label font (image_io.h), or in Helvetica if there is none. Throws
// RunError if it cannot be made.
std::string encode_pdf(const Drawing& drawing);

}  // namespace neumann
