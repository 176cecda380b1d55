// Builds self-contained HTML pages, with scripts, styles and data inlined.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace neumann {

// A file of apps/output/pages, or chart.js, which are embedded in the program; see embed.cmake.
std::string_view embedded_file(std::string_view name);

// The page `name` with each /*include FILE*/ replaced by that file, and /*data*/ by all of `data`.
std::string page(std::string_view name, const std::vector<std::string_view>& data);

// JSON, escaped for a script element.
std::string for_script(const nlohmann::ordered_json& json);

}  // namespace neumann
