// Reads glTF 2.0 files, .gltf and .glb (https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html); apps/manual/gltf.md says what
// becomes of what.
//
// By JSON for Modern C++ and not by tinygltf, which takes a property of a wrong type, or one that is misspelt, for one that is
// missing.
#pragma once

#include "core/reader/xml/problems.h"
#include "core/reader/xml/raw_scene.h"

#include "core/base/warnings.h"

#include <map>

namespace neumann::reader {

// Adds errors to `problems`, at their JSON pointers, and goes on without what is wrong. Throws InputError where there is no scene
// at all. `definitions`: of -D, among which `camera` chooses one.
RawScene import_gltf(const std::string& path, const NamedValues& definitions, Warnings& warnings, Problems& problems);

}  // namespace neumann::reader
