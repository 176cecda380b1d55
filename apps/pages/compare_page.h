// `neumann compare A B -o DIR`: a page that shows two renders side by side.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace neumann {

// Writes index.html, and `figures` as compare.json, into the folder `output`. A and B are folders of renders with the same picture
// size. Throws InputError if run.json or pictures are missing, if sizes differ, and if `output` holds files of another command,
// which would be lost.
void write_compare_page(const std::string& output, const std::string& a, const std::string& b,
                        const nlohmann::ordered_json& figures);

}  // namespace neumann
