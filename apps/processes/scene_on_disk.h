// A scene as every process finds it on its disk.
#pragma once

#include "apps/requests/scene_file.h"
#include "core/scene/scene.h"

#include <nlohmann/json.hpp>

#include <string>

namespace neumann {

struct SceneOnDisk {
    SceneFile file;  // its path is absolute
    std::string hash;
    bool operator==(const SceneOnDisk&) const = default;
};

nlohmann::ordered_json as_json(const SceneOnDisk& scene);
SceneOnDisk scene_from(const nlohmann::ordered_json& json);

// Throws InputError if it cannot be read, and RunError if it is another one than that with the hash.
Scene read(const SceneOnDisk& scene);

}  // namespace neumann
