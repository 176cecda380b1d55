// --method auto: chooses the method with the least error for its cost in a scene, among the unbiased ones or among all.
#pragma once

#include "operators/render/methods/goal.h"
#include "operators/render/methods/method_choice.h"
#include "operators/render/methods/render_job.h"

namespace neumann {

// Renders a small picture with each method and compares their work for the same error: rays · Σ_i E|error of K^i Le|² / |K^i Le|²,
// i ≥ 1. Counts rays, not seconds, so that the same seed chooses the same method anywhere. But if seconds are given (or no limit at
// all), the pictures take at most a twentieth of them, and methods whose preparation takes more than a twelfth of them are left
// out. A method with a bias is taken if its whole error is clearly smaller, for the work that the goal affords or that its error
// takes without bias. What the methods prepare for their pilots stays in `prepared`.
MethodChoice choose_method(const method::Auto& open, const Scene& scene, const Goal& goal, const PilotOnDemand& pilot,
                           Prepared& prepared, const Watch& watch);

}  // namespace neumann
