#include "apps/processes/scene_on_disk.h"

#include "core/base/error.h"
#include "core/reader/read_scene.h"

namespace neumann {

nlohmann::ordered_json as_json(const SceneOnDisk& scene) {
    return {{"path", scene.path}, {"definitions", scene.definitions}, {"lenient", scene.lenient}, {"hash", scene.hash}};
}

SceneOnDisk scene_from(const nlohmann::ordered_json& json) {
    return {json.at("path"), json.at("definitions").get<std::map<std::string, std::string>>(), json.at("lenient"), json.at("hash")};
}

Scene read(const SceneOnDisk& scene) {
    Scene read = read_scene(scene.path, scene.definitions, {.lenient = scene.lenient});
    if (read.hash != scene.hash) throw RunError(scene.path + " is another scene there");
    return read;
}

}  // namespace neumann
