// The pictures of a series for the page, slides, strips and sheets. `render` makes the pictures, and `page` reads them
// from its files; the result is the same.
#pragma once

#include "apps/output/files/output_folder.h"
#include "apps/output/files/packed_pictures.h"
#include "apps/requests/chosen_files.h"
#include "operators/render/from_paths/mixture.h"

#include <functional>
#include <string>

namespace neumann {

struct ShownSeries {
    std::size_t bounces = 0;  // N + 1
    bool has_rest = false, is_importance = false, is_subset = false;
    int width = 0, height = 0;
    std::string lenient_label, lenient_note;  // scene_json.h
    const Mixture* mixture = nullptr;
    // The pictures as in their files (in_file.h). Each is requested once, on any thread; term(N + 1) is the rest.
    std::function<PixelEstimate(std::size_t)> term, sum;
};

struct ShownPictures {
    std::string warning;    // reports that labels were left out; empty otherwise
    double exposure = 1.0;  // of the page, the contact sheet, the strips and the flip-book
};

// Packs the pictures for a page, and returns its exposure.
double pack_series(const ShownSeries& series, PackedSeries& packed);

// Packs the pictures if index.html is chosen, and writes the chosen ones of contact-sheet.png, bounces.gif and strips.
ShownPictures show_series(OutputFolder& folder, const ShownSeries& series, const ChosenFiles& files, PackedSeries& packed);

}  // namespace neumann
