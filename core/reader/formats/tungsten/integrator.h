// How many bounces there are, and which sides reflect.
#pragma once

#include "core/reader/formats/tungsten/importing.h"

namespace neumann::reader::tungsten {

// Adds the <integrator> to the scene, and says whether what reflects is two-sided.
void read_integrator(JsonObject& root, Importing& importing);

}  // namespace neumann::reader::tungsten
