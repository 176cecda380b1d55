// Reads the camera as a <sensor>.
#pragma once

#include "core/reader/formats/tungsten/importing.h"

namespace neumann::reader::tungsten {

// Adds the sensor to the scene.
void read_camera(JsonObject& root, Importing& importing);

}  // namespace neumann::reader::tungsten
