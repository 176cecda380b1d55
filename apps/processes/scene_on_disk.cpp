#include "apps/processes/scene_on_disk.h"

#include "apps/output/files/json_text.h"
#include "core/base/error.h"

namespace neumann {

nlohmann::ordered_json as_json(const SceneOnDisk& scene) {
    auto definitions = nlohmann::ordered_json::object();
    for (const auto& [name, value] : scene.file.definitions) definitions[name] = bytes_as_json(value);
    return {{"path", bytes_as_json(scene.file.path)},
            {"definitions", definitions},
            {"lenient", scene.file.lenient},
            {"hash", scene.hash}};
}

SceneOnDisk scene_from(const nlohmann::ordered_json& json) {
    SceneOnDisk scene{{bytes_from_json(json.at("path")), {}, json.at("lenient")}, json.at("hash")};
    for (const auto& [name, value] : json.at("definitions").items()) scene.file.definitions[name] = bytes_from_json(value);
    return scene;
}

Scene read(const SceneOnDisk& scene) {
    Scene found = read_scene(scene.file);
    if (found.hash != scene.hash) throw RunError(scene.file.path + " is another scene there");
    return found;
}

}  // namespace neumann
