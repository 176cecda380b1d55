// The files that a render writes beside run.json.
#pragma once

#include <string>
#include <vector>

namespace neumann {

struct ChosenFiles {
    bool pictures = true;  // bounce_000.exr …, sum_000.exr …, rest.exr, way_s1_t3.exr …
    bool tables = true;    // series.csv, convergence.csv
    bool sheets = true;    // contact-sheet.png, bounces.gif, ways.png
    bool strips = true;    // strip-terms.png …
    bool page = true;      // index.html
    bool layers = false;   // layers.exr, on request
    bool touch = false;    // touch.html, on request
    bool figures = false;  // figure-decay.svg, figure-decay.pdf, series.tex, on request
    bool white = false;    // sheets and strips have a white background instead of a black one
};

// The groups that are written by default: "pictures", "tables", "sheets", "strips", "page"; and all, with "layers",
// "touch" and "figures".
const std::vector<std::string>& file_groups();
const std::vector<std::string>& all_file_groups();
// The groups that `neumann page` makes: "sheets", "strips", "page".
const std::vector<std::string>& page_file_groups();

// Throws InputError for a name that is not a group.
ChosenFiles choose_files(const std::vector<std::string>& names, bool white = false);
std::vector<std::string> names_of(const ChosenFiles& files);

}  // namespace neumann
