// Reads scenes of Tungsten, .json (https://github.com/tunabrain/tungsten); apps/manual/tungsten.md says what becomes of what.
#pragma once

#include "core/base/warnings.h"
#include "core/reader/xml/problems.h"
#include "core/reader/xml/raw_scene.h"

namespace neumann::reader {

// Adds errors to `problems`, at their JSON pointers, and goes on without what is wrong. Throws InputError where there is no scene
// at all. `definitions`: of -D.
RawScene import_tungsten(const std::string& path, const NamedValues& definitions, Warnings& warnings, Problems& problems);

}  // namespace neumann::reader
