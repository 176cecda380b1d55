// Shows rough, small pictures at the beginning of a long render: from fields on few patches, in a fraction of a second.
#pragma once

#include "operators/render/methods/goal.h"
#include "operators/render/methods/method.h"
#include "operators/watch.h"

namespace neumann {

// Gives the pictures to watch.show. Does nothing if that is empty, if the render is short or begins with fields anyway,
// if the method makes only some of all paths, and in scenes with so many shapes that their patches take long.
void show_first_pictures(const Scene& scene, const Method& method, const Goal& goal, const Watch& watch);

}  // namespace neumann
