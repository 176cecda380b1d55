// index.html of a render, and of two that are compared: their pictures, bounce by bounce.
#pragma once

#include "apps/pages/packed_pictures.h"

#include <string>
#include <vector>

namespace neumann {

struct ExploredRun {
    nlohmann::ordered_json run;  // run.json
    std::string convergence;     // convergence.csv
    double exposure = 1.0;       // that the page begins with
    PackedSeries pictures;       // packed: bounces 0 … N, and the rest if `has_rest`
    bool has_rest = false;
};

// One run, or A and B with what `neumann compare` says of them (compare --json).
std::string explorer_page(const std::vector<const ExploredRun*>& runs, const nlohmann::ordered_json& comparison = nullptr);

}  // namespace neumann
