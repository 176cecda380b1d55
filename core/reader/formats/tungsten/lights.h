// Makes the primitives that are lights and no surfaces, as <emitter>s.
#pragma once

#include "core/reader/formats/tungsten/textures.h"

namespace neumann::reader::tungsten {

// These return whether the primitive emits; a light that does not is not added to the scene.
bool add_point(JsonObject& primitive, Textures& textures, Importing& importing);
// Adds light from everywhere, or a picture around the scene.
bool add_infinite_sphere(JsonObject& primitive, Textures& textures, Importing& importing);

}  // namespace neumann::reader::tungsten
