// Writes the pictures and the table of all ways (s, t) to make a bounce.
#pragma once

#include "apps/output/files/output_folder.h"
#include "apps/output/files/rendered_folder.h"
#include "apps/requests/chosen_files.h"
#include "operators/render/methods/ways.h"

#include <nlohmann/json.hpp>

#include <string>

namespace neumann {

// Writes the chosen ones of way_s1_t3.exr …, way_s1_t3_unweighted.exr …, and ways.png with all of them.
void write_ways(OutputFolder& folder, const Ways& ways, const ChosenFiles& files);
// Writes ways.png again, from the files of a render that has them.
void write_sheet_of_ways(OutputFolder& folder, const RenderedFolder& rendered);
std::string ways_table(const Ways& ways);
nlohmann::ordered_json as_json(const Ways& ways);

}  // namespace neumann
