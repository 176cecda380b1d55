// Tells the format of a scene file from its ending and its first bytes.
#pragma once

#include <string>

namespace neumann::reader {

enum class SceneFormat { mitsuba, collada, gltf, pbrt, tungsten };

// Throws InputError if the file is known to be something else than a scene, and says what it is and what can be done about it.
SceneFormat scene_format(const std::string& path);

}  // namespace neumann::reader
