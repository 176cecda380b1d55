// The bytes of files, and JSON in them.
#pragma once

#include "core/base/error.h"

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace neumann::reader {

// Throws InputError at the place: no such file, a folder or a device, not readable.
std::string read_bytes(const std::string& path, const Location& place);

// Throws InputError with the line and the column. A byte order mark of UTF-8 may stand before it.
nlohmann::json parse_json(const std::string& path, std::string_view text);

}  // namespace neumann::reader
