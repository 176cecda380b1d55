// The scene of a request.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace neumann {

struct Scene;

struct SceneFile {
    std::string path;
    std::map<std::string, std::string> definitions = {};  // -D name=value
    bool lenient = false;
    bool operator==(const SceneFile&) const = default;
};

// Reads the scene. Throws InputError.
Scene read_scene(const SceneFile& file);

// Reads texts "name=value". Throws InputError for others, and for a name that is given twice.
std::map<std::string, std::string> parse_definitions(const std::vector<std::string>& texts);

// The file of the bundled scene with this name, which is beside the program or Python's module as it was installed or
// built; the text itself if it is a file's name, or there is no such scene.
std::string scene_along(const std::string& name);

}  // namespace neumann
