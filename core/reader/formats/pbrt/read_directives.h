// Reads the language of pbrt files (pbrt-v4; pbrt.org/fileformat-v4).
#pragma once

#include "core/base/warnings.h"
#include "core/reader/formats/pbrt/pbrt_scene.h"
#include "core/reader/xml/problems.h"

namespace neumann::reader::pbrt {

// Reads a file and those that it includes. Adds errors to `problems`, and goes on at the next directive.
PbrtScene read_directives(const std::string& path, Warnings& warnings, Problems& problems);

}  // namespace neumann::reader::pbrt
