#include "apps/requests/scene_file.h"

#include "core/reader/read_scene.h"

namespace neumann {

Scene read_scene(const SceneFile& file) { return read_scene(file.path, file.definitions, {.lenient = file.lenient}); }

}  // namespace neumann
