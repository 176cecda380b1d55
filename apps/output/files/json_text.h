// JSON as text.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace neumann {

// JSON is UTF-8, but names of files are bytes: invalid bytes are replaced by �. `indent`: −1 for one line.
inline std::string json_text(const nlohmann::ordered_json& json, int indent = -1) {
    return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

// The file whose name json_text() wrote as `name`; the name itself, unless exactly one existing file fits.
std::string file_named_in_json(const std::string& name);

// Stores a text whose bytes must all be preserved, and restores it.
inline nlohmann::ordered_json bytes_as_json(std::string_view text) { return std::vector<unsigned char>(text.begin(), text.end()); }
inline std::string bytes_from_json(const nlohmann::ordered_json& json) {
    const auto bytes = json.get<std::vector<unsigned char>>();
    return {bytes.begin(), bytes.end()};
}

}  // namespace neumann
