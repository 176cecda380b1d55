// A rendered series as the files that a user finds in the output folder.
#pragma once

#include "apps/output_folder.h"
#include "apps/pages/packed_pictures.h"
#include "operators/pictures/bounce_series.h"

#include <nlohmann/json.hpp>
#include <string>

namespace neumann {

struct WrittenPictures {
    std::string warning;    // where labels were left out, or nothing
    double exposure = 1.0;  // of the sheet, the strips and the flip-book
};

// bounce_000.exr …, sum_000.exr …, rest.exr, contact-sheet.png, bounces.gif, strip-terms.png …; and the pictures for the page,
// packed.
WrittenPictures write_pictures(OutputFolder& folder, const BounceSeries& series, PackedSeries& packed);

// series.csv, and convergence.csv.
std::string series_table(const SeriesReport& report);
std::string convergence_table(const std::vector<Checkpoint>& convergence);

// "bounce_003.exr", "sum_003.exr".
std::string bounce_file(std::size_t i);
std::string sum_file(std::size_t i);

}  // namespace neumann
