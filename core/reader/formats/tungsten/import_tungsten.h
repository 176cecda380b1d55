// Reads scenes of Tungsten, .json (https://github.com/tunabrain/tungsten); apps/manual/tungsten.md describes what
// becomes of each property.
#pragma once

#include "core/base/warnings.h"
#include "core/reader/xml/problems.h"
#include "core/reader/xml/raw_scene.h"

namespace neumann::reader {

// Adds errors to `problems`, at their JSON pointers, and reads on without what is wrong. Throws InputError if there is
// no scene at all. `definitions` are those of -D.
RawScene import_tungsten(const std::string& path, const NamedValues& definitions, Warnings& warnings, Problems& problems);

}  // namespace neumann::reader
