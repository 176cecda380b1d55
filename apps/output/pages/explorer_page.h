// index.html of a render, or of two renders that are compared: their pictures, bounce by bounce.
#pragma once

#include "apps/output/files/packed_pictures.h"

#include <string>
#include <string_view>
#include <vector>

namespace neumann {

struct ExploredRun {
    nlohmann::ordered_json run;  // run.json
    std::string convergence;     // convergence.csv
    double exposure = 1.0;       // initial exposure of the page
    PackedSeries pictures;       // packed: bounces 0 … N, and the rest if `has_rest`
    bool has_rest = false;
    nlohmann::ordered_json paths = nullptr;  // the paths of some pixels (paths_json.h)
    bool is_under_way = false;               // the page shows that the render is not finished
};

// `runs`: one run, or A and B; `comparison`: for two runs, the output of `neumann compare --json`.
std::string explorer_page(const std::vector<const ExploredRun*>& runs, const nlohmann::ordered_json& comparison = nullptr);

// The elements of the page that hold the data; and the page with these elements.
std::string explorer_data(const std::vector<const ExploredRun*>& runs, const nlohmann::ordered_json& comparison = nullptr);
std::string explorer_page(std::string_view data);

}  // namespace neumann
