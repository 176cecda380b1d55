// A scene that every process finds on its disk.
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

// Reads it. Throws InputError if it cannot be read, and RunError if its hash differs.
Scene read(const SceneOnDisk& scene);

}  // namespace neumann
