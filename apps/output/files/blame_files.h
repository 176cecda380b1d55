// The results of `neumann blame` as JSON and as pictures.
#pragma once

#include "apps/output/files/output_folder.h"
#include "operators/experiments/blame/blame.h"

#include <nlohmann/json.hpp>

#include <string>

namespace neumann {

// Lengths in scene units, values in W·m⁻²·sr⁻¹; places and "film" in pixels from the upper left corner of the pictures.
nlohmann::ordered_json blame_json(const Blame& found, const Scene& scene);

// Writes difference_002.exr with standard errors and z_002.exr for each term; difference_000-001.exr for bounces 0 and 1.
void write_blame_pictures(OutputFolder& folder, const Blame& found);

// The path as text: "camera → shape 'floor', room.xml:5:1 → lamp 'shape', room.xml:9:1".
std::string path_text(const OurPath& path, const Scene& scene);

}  // namespace neumann
