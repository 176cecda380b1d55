// Reads COLLADA 1.4 and 1.5, and what the courses CMU 15-462 and Berkeley CS184 add to it; apps/manual/collada.md
// describes what becomes of each element. The axes and units of the file are kept.
#pragma once

#include "core/base/warnings.h"
#include "core/reader/xml/problems.h"
#include "core/reader/xml/raw_scene.h"

#include <string>

namespace neumann::reader {

// Adds errors to `problems` and reads on without what is wrong. Throws InputError if the file is no COLLADA scene at all.
RawScene read_collada(const std::string& path, const NamedValues& definitions, Warnings& warnings, Problems& problems);

}  // namespace neumann::reader
