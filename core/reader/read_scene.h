// Mitsuba 3 scene files.
#pragma once

#include "core/base/error.h"
#include "core/scene/scene.h"

#include <map>
#include <string>

namespace neumann {

// Reads an XML scene file. `definitions` are the -D name=value of the command line, which override the file's <default>s. Errors
// are InputError "file:line:column: what is wrong, what was expected". Everything that is unsupported, unknown, misspelt or unused
// is an error that names it; nothing is skipped silently. A definition that the file does not use is an error, unless `optional`.
Scene read_scene(const std::string& path, const std::map<std::string, std::string>& definitions = {}, bool optional = false);
// The same, before the acceleration structures are built.
SceneParts read_scene_parts(const std::string& path, const std::map<std::string, std::string>& definitions = {},
                            bool optional = false);

}  // namespace neumann
