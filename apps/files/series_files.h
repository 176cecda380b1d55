// A rendered series as the files that a user finds in the output folder.
#pragma once

#include "apps/files/output_folder.h"
#include "apps/pages/packed_pictures.h"
#include "core/sensor/sensor_options.h"
#include "operators/methods/bounce_series.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace neumann {

struct WrittenPictures {
    std::string warning;    // where labels were left out, or nothing
    double exposure = 1.0;  // of the sheet, the strips and the flip-book
};

// bounce_000.exr …, sum_000.exr …, rest.exr, contact-sheet.png, bounces.gif, strip-terms.png …; and the pictures for the page,
// packed.
WrittenPictures write_pictures(OutputFolder& folder, const BounceSeries& series, PackedSeries& packed);

// About as many bytes as a render writes, were its EXR files not compressed.
double estimated_bytes(const Film& film, int bounces, bool has_discretisation);

// For a disk that does not take everything: series.csv and those of bounce_000.exr … and rest.exr that fit. Returns the names of
// those that do not.
std::vector<std::string> write_terms_that_fit(OutputFolder& folder, const BounceSeries& series);

// series.csv, and convergence.csv.
std::string series_table(const SeriesReport& report);
std::string convergence_table(const std::vector<Checkpoint>& convergence);

// "bounce_003.exr", "sum_003.exr".
std::string bounce_file(std::size_t i);
std::string sum_file(std::size_t i);

}  // namespace neumann
