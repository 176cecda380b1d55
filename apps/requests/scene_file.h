// A scene as it is asked for.
#pragma once

#include <map>
#include <string>

namespace neumann {

struct Scene;

struct SceneFile {
    std::string path;
    std::map<std::string, std::string> definitions = {};  // -D name=value
    bool lenient = false;
    bool operator==(const SceneFile&) const = default;
};

// Throws InputError.
Scene read_scene(const SceneFile& file);

}  // namespace neumann
