// The files that `neumann unbounce` writes and reads: pictures under separate lights, terms backward and forward, JSON.
#pragma once

#include "apps/output/files/output_folder.h"
#include "operators/experiments/unbounce/doubts.h"
#include "operators/experiments/unbounce/light_renders.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace neumann {

// A folder of pictures under separate lights: light_000.exr …, with direct_000.exr … and forward_001.exr … if they
// exist, or else all OpenEXR files, by name.
struct LightFolder {
    std::vector<std::string> lights, direct, forward;  // paths
    std::optional<std::pair<int, int>> blocks;         // columns and rows, if neumann rendered them
};

// Throws InputError if there are no pictures, or not as many of direct light.
LightFolder read_light_folder(const std::string& folder);
// The mean and, if the file has them, errors. Throws InputError as read_exr().
Estimate read_light(const std::string& path);

// Reads the regions: region j + 1 for light j, 0 for none. Throws InputError for values that are not whole.
Regions read_regions(const std::string& path);

// Writes light_000.exr …, direct_000.exr … and forward_001.exr ….
void write_light_renders(OutputFolder& folder, const LightRenders& renders);

// Writes backward_001.exr …, backward_rest.exr and unbounced.png.
void write_unbounced(OutputFolder& folder, const Unbounced& found, const std::vector<Estimate>& forward);

nlohmann::ordered_json unbounce_json(const Unbounced& found, const std::vector<std::string>& names,
                                     const std::vector<TermAgreement>& forward, const std::vector<Doubt>& doubts);

}  // namespace neumann
