// Reads a scene file of any format.
#pragma once

#include "core/base/warnings.h"
#include "core/reader/xml/problems.h"
#include "core/reader/xml/raw_scene.h"

#include <map>
#include <string>

namespace neumann::reader {

// Adds errors to `problems` and reads on without what is wrong. Throws InputError if the file cannot be read as a scene
// at all, and says what it is if it is something else. `definitions` are those of -D.
RawScene read_raw_scene(const std::string& path, const NamedValues& definitions, Warnings& warnings, Problems& problems);

}  // namespace neumann::reader
