#include "apps/processes/scene_on_disk.h"

#include "apps/output/files/json_text.h"
#include "core/base/error.h"

namespace neumann {

nlohmann::ordered_json as_json(const SceneOnDisk& scene) {
    auto definitions = nlohmann::ordered_json::object();
    for (const auto& [name, value] : scene.file.definitions) definitions[name] = bytes_as_json(value);
    nlohmann::ordered_json json = {{"path", bytes_as_json(scene.file.path)},
                                   {"definitions", definitions},
                                   {"lenient", scene.file.lenient},
                                   {"hash", scene.hash}};
    if (scene.file.hemisphere) json["hemisphere"] = *scene.file.hemisphere;
    return json;
}

SceneOnDisk scene_from(const nlohmann::ordered_json& json) {
    SceneOnDisk scene{{bytes_from_json(json.at("path")), {}, json.at("lenient")}, json.at("hash")};
    if (json.contains("hemisphere")) scene.file.hemisphere = json.at("hemisphere").get<std::array<int, 2>>();
    for (const auto& [name, value] : json.at("definitions").items()) scene.file.definitions[name] = bytes_from_json(value);
    return scene;
}

Scene read(const SceneOnDisk& scene) {
    Scene found = read_scene(scene.file);
    if (found.hash != scene.hash) throw RunError(scene.file.path + " is another scene there");
    return found;
}

}  // namespace neumann
