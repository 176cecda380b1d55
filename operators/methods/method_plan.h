// What a method does not need of a scene.
#pragma once

#include "operators/methods/method.h"
#include "operators/plan/plan.h"

namespace neumann {

// Without parts where nothing is to be left out, or the method can do without nothing.
Plan plan_for(const Method& method, const Scene& scene);
// All parts of a scene, and the bounces that a render would leave out where none are asked for.
Plan plan_with_bounces(const Scene& scene);

}  // namespace neumann
