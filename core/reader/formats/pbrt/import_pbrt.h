// Reads scenes of pbrt-v4.
#pragma once

#include "core/base/warnings.h"
#include "core/reader/xml/problems.h"
#include "core/reader/xml/raw_scene.h"

#include <string>

namespace neumann::reader {

// Adds errors to `problems` and reads on without what is wrong. Throws InputError if the file cannot be opened.
RawScene import_pbrt(const std::string& path, const NamedValues& definitions, Warnings& warnings, Problems& problems);

}  // namespace neumann::reader
