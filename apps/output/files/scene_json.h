// The scene of a run, as its JSON and its pictures describe it.
#pragma once

#include "apps/requests/scene_file.h"
#include "core/scene/scene.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace neumann {

// The file, hash and definitions, and the things that a lenient reader replaced or left out, if any.
nlohmann::ordered_json scene_json(const Scene& scene, const SceneFile& file);

// The text in the headers of pictures of a scene that a lenient reader changed, and the text appended to their labels;
// both are empty for other scenes. `replaced`: Scene::replaced.
std::string lenient_note(const std::vector<std::string>& replaced);
std::string lenient_label(const std::vector<std::string>& replaced);
inline std::string lenient_note(const Scene& scene) { return lenient_note(scene.replaced); }
inline std::string lenient_label(const Scene& scene) { return lenient_label(scene.replaced); }

}  // namespace neumann
