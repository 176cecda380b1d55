// KHR_lights_punctual: lights without extent, as <emitter>s.
#pragma once

#include "core/reader/formats/gltf/nodes.h"
#include "core/reader/xml/element.h"

namespace neumann::reader::gltf {

// Candela and lux count lumens. A watt at 555 nm, where the eye sees best, has this many; Blender and others convert by it.
constexpr double lumens_per_watt = 683.0;

// Throws InputError.
Element make_light(const Placed& placed, JsonObject light);

}  // namespace neumann::reader::gltf
