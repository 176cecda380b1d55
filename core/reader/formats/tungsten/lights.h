// Primitives that are lights and no surfaces, as <emitter>s.
#pragma once

#include "core/reader/formats/tungsten/textures.h"

namespace neumann::reader::tungsten {

// Return whether they emit; a light that does not is not added to the scene.
bool add_point(JsonObject& primitive, Textures& textures, Importing& importing);
// Light from everywhere, or a picture around the scene.
bool add_infinite_sphere(JsonObject& primitive, Textures& textures, Importing& importing);

}  // namespace neumann::reader::tungsten
