// The scenes that speed is measured on.
#pragma once

#include "core/scene/scene.h"

namespace neumann {

Scene cornell_box();
// A room whose floor is a landscape of 2·n² triangles, lit from the ceiling.
Scene landscape(int n);

}  // namespace neumann
