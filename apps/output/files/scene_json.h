// The scene of a run, as its JSON and its pictures name it.
#pragma once

#include "apps/requests/scene_file.h"
#include "core/scene/scene.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace neumann {

// File, hash and definitions, and what a lenient reader replaced or left out, if anything.
nlohmann::ordered_json scene_json(const Scene& scene, const SceneFile& file);

// For pictures of a scene that a lenient reader changed: what their headers say, and what is appended to their labels; both are
// empty for other scenes. `replaced`: Scene::replaced.
std::string lenient_note(const std::vector<std::string>& replaced);
std::string lenient_label(const std::vector<std::string>& replaced);
inline std::string lenient_note(const Scene& scene) { return lenient_note(scene.replaced); }
inline std::string lenient_label(const Scene& scene) { return lenient_label(scene.replaced); }

}  // namespace neumann
