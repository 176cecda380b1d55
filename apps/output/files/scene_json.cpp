#include "apps/output/files/scene_json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace neumann {

nlohmann::ordered_json scene_json(const Scene& scene, const SceneFile& file) {
    nlohmann::ordered_json json = {{"file", file.path}, {"hash", scene.hash}, {"definitions", file.definitions}};
    if (file.hemisphere) json["hemisphere"] = *file.hemisphere;
    if (!scene.replaced.empty()) json["replaced"] = scene.replaced;
    return json;
}

std::string lenient_note(const std::vector<std::string>& replaced) {
    if (replaced.empty()) return "";
    return fmt::format("not the scene as it is written: it was read with --lenient\n{}", fmt::join(replaced, "\n"));
}

std::string lenient_label(const std::vector<std::string>& replaced) { return replaced.empty() ? "" : ", lenient"; }

}  // namespace neumann
