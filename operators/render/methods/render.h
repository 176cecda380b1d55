// A render is a function of a scene, a method and a goal.
#pragma once

#include "operators/render/from_paths/pilot.h"
#include "operators/render/methods/bounce_series.h"
#include "operators/render/methods/goal.h"
#include "operators/render/methods/saving.h"

namespace neumann {

// Renders L = Le + K Le + K² Le + …, bounce by bounce. If `watch` stops it, it returns what it has. Throws InputError
// if scene, method and goal are incompatible, and RunError if a tail cannot be met or nothing was finished before the
// stop. The result holds no reference to the scene.
BounceSeries render(const Scene& scene, const Method& method, const Goal& goal, const Watch& watch = {});
// As above; the render is saved while it is under way.
BounceSeries render(const Scene& scene, const Method& method, const Goal& goal, const Watch& watch, Saving saving);
// As above, with an existing pilot of the scene.
BounceSeries render(const Scene& scene, const Method& method, const Goal& goal, const Watch& watch, const Pilot& pilot,
                    Saving saving = {});

}  // namespace neumann
