// A scene as every process finds it on its disk.
#pragma once

#include "core/scene/scene.h"

#include <nlohmann/json.hpp>

#include <map>
#include <string>

namespace neumann {

struct SceneOnDisk {
    std::string path;  // absolute
    std::map<std::string, std::string> definitions;
    bool lenient = false;
    std::string hash;
    bool operator==(const SceneOnDisk&) const = default;
};

nlohmann::ordered_json as_json(const SceneOnDisk& scene);
SceneOnDisk scene_from(const nlohmann::ordered_json& json);

// Throws InputError if it cannot be read, and RunError if it is another one than that with the hash.
Scene read(const SceneOnDisk& scene);

}  // namespace neumann
