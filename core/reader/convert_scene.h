// Converts a scene of any format to a Mitsuba 3 file.
#pragma once

#include "core/base/warnings.h"

#include <map>
#include <string>

namespace neumann {

struct ConvertedScene {
    std::string xml;
    std::map<std::string, std::string> files;  // the files that `xml` names, by their paths relative to it
    Warnings warnings;
};

// Reads the scene as a whole first, so only a scene that read_scene() takes is converted; throws InputError as that
// does. Included files and the values of parameters are put in, and meshes and pictures come along. With `lenient`,
// unknown plugins and parameters stay in the file as they are, and unknown elements do not.
ConvertedScene convert_scene(const std::string& path, const std::map<std::string, std::string>& definitions = {},
                             bool lenient = false);

}  // namespace neumann
