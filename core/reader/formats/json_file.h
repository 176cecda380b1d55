// Reads the bytes of files, and parses JSON.
#pragma once

#include "core/base/error.h"

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace neumann::reader {

// Throws InputError at `place` if the file does not exist, is a folder or a device, or cannot be read.
std::string read_bytes(const std::string& path, const Location& place);

// Throws InputError with the line and the column. The text may begin with a byte order mark of UTF-8.
nlohmann::json parse_json(const std::string& path, std::string_view text);

}  // namespace neumann::reader
