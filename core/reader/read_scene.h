// Reads scene files.
#pragma once

#include "core/base/error.h"
#include "core/scene/scene.h"

#include <map>
#include <string>

namespace neumann {

// How strict a reader is.
struct Reading {
    bool optional_definitions = false;  // a definition that the file does not use is no error
    // What is unknown is no error: materials become grey and diffuse; lights, shapes and parameters are left out. Each
    // is named in SceneNotes::replaced.
    bool lenient = false;
};

// Reads a scene file, in XML or of a format that is imported. `definitions` are the -D name=value of the command line,
// which override the file's <default>s. Errors are InputError "file:line:column: what is wrong, what was expected".
// Everything that is unsupported, unknown, misspelt or unused is an error that names it; nothing is skipped silently.
// Errors that a lenient reader would not have are an UnknownError.
Scene read_scene(const std::string& path, const std::map<std::string, std::string>& definitions = {}, const Reading& reading = {});
// Reads the same, but does not build the acceleration structures.
SceneParts read_scene_parts(const std::string& path, const std::map<std::string, std::string>& definitions = {},
                            const Reading& reading = {});

}  // namespace neumann
