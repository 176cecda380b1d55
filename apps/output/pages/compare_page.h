// `neumann compare A B -o DIR`: a page that shows renders side by side.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace neumann {

// Writes index.html, and `figures` as compare.json, into the folder `output`. The others are folders of renders with the same
// picture size. Throws InputError if run.json or pictures are missing, if sizes differ, and if `output` holds files of another
// command, which would be lost.
void write_compare_page(const std::string& output, const std::vector<std::string>& folders, const nlohmann::ordered_json& figures);

}  // namespace neumann
