// The extensions of glTF that files may use.
#pragma once

#include "core/reader/formats/json_object.h"

namespace neumann::reader::gltf {

// Whether an extension changes no still picture, or the file has what is needed without it.
bool has_no_effect(const std::string& extension);

// Adds a problem for each required extension that is not known, and a warning for each other one.
void check_extensions(JsonObject& root);

// Throws because a part of the file is compressed by this extension; a lenient reader leaves out what needs it.
[[noreturn]] void fail_compressed(const std::string& extension, const Location& place, const Notes& notes);

}  // namespace neumann::reader::gltf
