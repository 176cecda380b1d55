// `neumann compare A B -o DIR`: a page that shows two renders beside each other.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace neumann {

// Writes index.html, and `figures` as compare.json, into the folder `output`. A and B are folders that render wrote, of pictures of
// one size. Throws InputError where run.json or pictures are missing or not of one size, and where `output` holds files of another
// command, which would be lost.
void write_compare_page(const std::string& output, const std::string& a, const std::string& b,
                        const nlohmann::ordered_json& figures);

}  // namespace neumann
