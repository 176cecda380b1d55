// A scene of any format as a Mitsuba 3 file.
#pragma once

#include "core/base/warnings.h"

#include <map>
#include <string>

namespace neumann {

struct ConvertedScene {
    std::string xml;
    std::map<std::string, std::string> files;  // that it names, by their paths relative to it
    Warnings warnings;
};

// The scene is read whole first, so it is one that read_scene() takes; throws InputError as that does. What a file includes is put
// in, and so are its parameters. With `lenient`, plugins and parameters that
// are not known stay in the file as they are, elements that are not known do not. Meshes and pictures come along.
ConvertedScene convert_scene(const std::string& path, const std::map<std::string, std::string>& definitions = {},
                             bool lenient = false);

}  // namespace neumann
