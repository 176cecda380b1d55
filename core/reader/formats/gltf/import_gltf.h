// Reads glTF 2.0 files, .gltf and .glb (https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html); apps/manual/gltf.md
// describes what becomes of each property.
// The reader uses JSON for Modern C++ and not tinygltf, which takes a property that is misspelt or of a wrong type for
// one that is missing.
#pragma once

#include "core/reader/xml/problems.h"
#include "core/reader/xml/raw_scene.h"

#include "core/base/warnings.h"

#include <map>

namespace neumann::reader {

// Adds errors to `problems`, at their JSON pointers, and reads on without what is wrong. Throws InputError if there is
// no scene at all. `definitions` are those of -D; `camera` among them chooses a camera.
RawScene import_gltf(const std::string& path, const NamedValues& definitions, Warnings& warnings, Problems& problems);

}  // namespace neumann::reader
