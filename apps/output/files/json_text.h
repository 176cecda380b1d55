// JSON as text.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace neumann {

// Names of files are bytes, and JSON is UTF-8: bytes that are none are replaced by �. `indent`: −1 for one line.
inline std::string json_text(const nlohmann::ordered_json& json, int indent = -1) {
    return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

// The file that json_text() wrote this name of, relative or not; the name itself, unless exactly one file that is there fits.
std::string file_named_in_json(const std::string& name);

// A text whose bytes all arrive, whatever they are, and the way back.
inline nlohmann::ordered_json bytes_as_json(std::string_view text) { return std::vector<unsigned char>(text.begin(), text.end()); }
inline std::string bytes_from_json(const nlohmann::ordered_json& json) {
    const auto bytes = json.get<std::vector<unsigned char>>();
    return {bytes.begin(), bytes.end()};
}

}  // namespace neumann
