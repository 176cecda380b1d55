// Reads how many bounces there are, and which sides reflect.
#pragma once

#include "core/reader/formats/tungsten/importing.h"

namespace neumann::reader::tungsten {

// Adds the <integrator> to the scene, and sets `importing.two_sided`.
void read_integrator(JsonObject& root, Importing& importing);

}  // namespace neumann::reader::tungsten
