// The work that a method can leave out in a scene.
#pragma once

#include "operators/render/methods/method.h"
#include "operators/render/plan/plan.h"

namespace neumann {

// The plan for a method. It has no parts if the options forbid leaving anything out, or the method has no plan.
Plan plan_for(const Method& method, const Scene& scene);
// All parts of the scene's plan, and the late bounces that a render without a given N would leave out.
Plan plan_with_bounces(const Scene& scene);

}  // namespace neumann
