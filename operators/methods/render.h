// A render is a function of a scene, a method and a goal.
#pragma once

#include "operators/methods/bounce_series.h"
#include "operators/methods/goal.h"

namespace neumann {

// L = Le + K Le + K² Le + …, bounce by bounce. Stopped by `watch`, it returns what it has. Throws InputError where scene, method
// and goal do not go together, and RunError where a tail cannot be met or nothing was finished before it was stopped. Nothing in
// the result refers to the scene.
BounceSeries render(const Scene& scene, const Method& method, const Goal& goal, const Watch& watch = {});
// The same with a pilot of the scene that was there before.
BounceSeries render(const Scene& scene, const Method& method, const Goal& goal, const Watch& watch, const Pilot& pilot);

}  // namespace neumann
