// Pages that need no other file: scripts, styles and data become part of them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace neumann {

// A file of apps/pages, or chart.js, which is part of the program; see embed.cmake.
std::string_view embedded_file(std::string_view name);

// The page `name` with each /*include FILE*/ replaced by that file, and /*data*/ by `data`.
std::string page(std::string_view name, std::string_view data);

// JSON as it may stand in a script element.
std::string for_script(const nlohmann::ordered_json& json);

}  // namespace neumann
