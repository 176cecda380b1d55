// Pictures for the first moment of a render that takes a while: of fields on few patches, rough and small, in a fraction of a
// second.
#pragma once

#include "operators/render/methods/goal.h"
#include "operators/render/methods/method.h"
#include "operators/watch.h"

namespace neumann {

// Gives them to watch.show. Does nothing if that is empty, where the render is short or begins with fields anyway, where the method
// makes only some of all paths, and in scenes of so many shapes that patches of them take long.
void show_first_pictures(const Scene& scene, const Method& method, const Goal& goal, const Watch& watch);

}  // namespace neumann
