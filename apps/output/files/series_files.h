// Writes a rendered series into the output folder.
#pragma once

#include "apps/output/files/output_folder.h"
#include "apps/output/files/shown_series.h"
#include "apps/requests/chosen_files.h"
#include "core/scene/scene.h"
#include "operators/render/methods/bounce_series.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace neumann {

// Writes the chosen ones of bounce_000.exr …, sum_000.exr …, rest.exr, contact-sheet.png, bounces.gif, strip-terms.png
// …, and packs the pictures if index.html is chosen.
ShownPictures write_pictures(OutputFolder& folder, const BounceSeries& series, const ChosenFiles& files, const Scene& scene,
                             PackedSeries& packed);

// Packs the pictures for a page, and returns its exposure.
double pack_pictures(const BounceSeries& series, const Scene& scene, PackedSeries& packed);

// The contents of bounce_000.exr …, sum_000.exr … and rest.exr.
std::string term_exr(const BounceSeries& series, const Scene& scene, std::size_t i, const PixelEstimate& term);
std::string sum_exr(const BounceSeries& series, const Scene& scene, std::size_t i, const PixelEstimate& sum);
std::string rest_exr(const BounceSeries& series, const Scene& scene);

// Writes layers.exr: a part for each bounce, as in its own file, for their sum and for the rest.
void write_layers(OutputFolder& folder, const BounceSeries& series, const Scene& scene);

// The approximate number of bytes that a render writes if its EXR files do not compress.
double estimated_bytes(const Film& film, int bounces, bool has_discretisation, const ChosenFiles& files);

// For a full disk: writes series.csv, and the bounce_000.exr … and rest.exr that fit. Returns the names of the others.
std::vector<std::string> write_terms_that_fit(OutputFolder& folder, const BounceSeries& series, const Scene& scene);

// The contents of series.csv and of convergence.csv.
std::string series_table(const SeriesReport& report);
std::string convergence_table(const std::vector<Checkpoint>& convergence);

// "bounce_003.exr", "sum_003.exr".
std::string bounce_file(std::size_t i);
std::string sum_file(std::size_t i);

}  // namespace neumann
