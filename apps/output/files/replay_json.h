// A path that was traced again, in words and as JSON.
#pragma once

#include "core/scene/scene.h"
#include "operators/render/report/replay.h"

#include <nlohmann/json.hpp>

#include <string>

namespace neumann {

// "from the camera", "reflection 2 of the light's path", "looks for light for bounce 1".
std::string heading(const PathStep& step);

// Three numbers; a number that is not finite becomes a text.
nlohmann::ordered_json as_json(const Vec3& x);

nlohmann::ordered_json as_json(const ReplayedStep& step, const Scene& scene);

}  // namespace neumann
