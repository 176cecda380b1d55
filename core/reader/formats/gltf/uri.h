// Reads the URIs of a glTF file.
#pragma once

#include "core/base/error.h"

#include <string>
#include <vector>

namespace neumann::reader::gltf {

// The bytes of a data URI, or of a file by its path from the folder of the glTF file; %20 and the like are decoded, and
// \ may stand for /. Adds the names of files that are read to `files`. Throws InputError at the place.
std::string read_uri(const std::string& uri, const std::string& gltf_path, const Location& place, std::vector<std::string>& files);

}  // namespace neumann::reader::gltf
