#include "core/reader/read_scene.h"

namespace neumann {

Scene read_scene(const std::string& path, const std::map<std::string, std::string>& definitions, bool optional) {
    return make_scene(read_scene_parts(path, definitions, optional));
}

}  // namespace neumann
