// touch.html: a page on which materials and lamps can be changed, and all bounces follow.
#pragma once

#include "operators/fields/matrix/separated_scene.h"
#include "operators/render/methods/bounce_series.h"

#include <string>

namespace neumann {

// `rendered`: the same scene by any method, shown beside it. `name`: the scene's.
std::string touch_page(const SeparatedScene& scene, const BounceSeries& rendered, const std::string& name);

}  // namespace neumann
