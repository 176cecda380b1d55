// The files of `neumann strip`: strip.png, strip.svg and strip.json.
#pragma once

#include "apps/output/files/output_folder.h"
#include "apps/output/sheets/labelled_picture.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

struct StripTile {
    std::string label;
    std::string why;      // why there is no picture, in words; then all that follows has no meaning
    Image picture;        // as in the file that `render` writes
    double factor = 1.0;  // extra brightness
    double error = 0.0;   // relative standard error; infinite if unknown
    bool is_biased = false;
    std::string method;
    int bounces = 0;  // the last one in the picture
    std::uint64_t samples = 0;
    double seconds = 0.0;
    std::optional<std::array<Rgb, 2>> marked{};  // the marked pixel's value and standard error
};

struct VariedStrip {
    std::vector<std::vector<StripTile>> rows;  // with at least one picture
    std::string heading;                       // lines below the pictures
    std::string note;                          // a comment in the files, or empty
    double exposure = 1.0;
    std::optional<std::array<int, 2>> mark;
};

// Writes strip.png and strip.svg. Returns whether the PNG file has labels: there may be no font.
bool write_strip_pictures(OutputFolder& folder, const VariedStrip& strip, SheetTheme theme);
// The exposure, the mark and the tiles, for strip.json.
nlohmann::ordered_json as_json(const VariedStrip& strip);

}  // namespace neumann
