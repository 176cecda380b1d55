// Reads a scene file of any format, by its ending.
#pragma once

#include "core/reader/raw_scene.h"

namespace neumann::reader {

// Throws InputError where the file cannot be read as a scene at all, and says what it is if it is something else.
RawScene read_raw_scene(const std::string& path);

}  // namespace neumann::reader
