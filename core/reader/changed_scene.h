// Scenes that exist in memory only, or that are a scene file with changes.
#pragma once

#include "core/reader/read_scene.h"
#include "core/reader/xml/edit.h"
#include "core/reader/xml/raw_scene.h"

#include <memory>

namespace neumann {

struct SceneChanges {
    std::shared_ptr<const reader::RawScene> in_memory = {};  // the scene, in place of the file
    std::vector<reader::Edit> edits = {};                    // applied in this order
};

// Reads a scene with these changes, otherwise as read_scene_parts(path, …) does. The hash covers the changes. Files
// that a scene in memory names are searched for from the current folder.
SceneParts read_scene_parts(const std::string& path, const std::map<std::string, std::string>& definitions, const Reading& reading,
                            const SceneChanges& changes);

}  // namespace neumann
