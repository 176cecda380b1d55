// What a file is, by its ending and by how it begins.
#pragma once

#include <string>

namespace neumann::reader {

enum class SceneFormat { mitsuba, collada, gltf, pbrt, tungsten };

// Throws InputError, with what the file is and what can be done about it, where it is known to be something else than a scene.
SceneFormat scene_format(const std::string& path);

}  // namespace neumann::reader
