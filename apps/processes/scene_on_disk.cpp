#include "apps/processes/scene_on_disk.h"

#include "apps/output/files/json_text.h"
#include "core/base/error.h"
#include "core/reader/read_scene.h"

namespace neumann {

nlohmann::ordered_json as_json(const SceneOnDisk& scene) {
    auto definitions = nlohmann::ordered_json::object();
    for (const auto& [name, value] : scene.definitions) definitions[name] = bytes_as_json(value);
    return {{"path", bytes_as_json(scene.path)}, {"definitions", definitions}, {"lenient", scene.lenient}, {"hash", scene.hash}};
}

SceneOnDisk scene_from(const nlohmann::ordered_json& json) {
    SceneOnDisk scene{bytes_from_json(json.at("path")), {}, json.at("lenient"), json.at("hash")};
    for (const auto& [name, value] : json.at("definitions").items()) scene.definitions[name] = bytes_from_json(value);
    return scene;
}

Scene read(const SceneOnDisk& scene) {
    Scene read = read_scene(scene.path, scene.definitions, {.lenient = scene.lenient});
    if (read.hash != scene.hash) throw RunError(scene.path + " is another scene there");
    return read;
}

}  // namespace neumann
