// The scenes that come with the program.
#pragma once

#include <string>

namespace neumann {

// The file of the scene with this name, beside the program or Python's module as it was installed or built; the text itself if it
// is a file's name, or there is no such scene.
std::string scene_along(const std::string& name);

}  // namespace neumann
