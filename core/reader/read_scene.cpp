#include "core/reader/read_scene.h"

namespace neumann {

Scene read_scene(const std::string& path, const std::map<std::string, std::string>& definitions, const Reading& reading) {
    return make_scene(read_scene_parts(path, definitions, reading));
}

}  // namespace neumann
