// Reads what primitives emit.
#pragma once

#include "core/reader/formats/tungsten/textures.h"

namespace neumann::reader::tungsten {

// The property `power` times `of_unit_power`, the radiance (or intensity) for a unit of power, or else the property
// `emission`; nothing if it is 0 or missing.
std::optional<TextureValue> find_emission(JsonObject& primitive, Textures& textures, double of_unit_power);

// The radiance with which a surface of this area emits the power 1.
double radiance_of_unit_power(double area);

// Adds an <emitter type="area"> to the shape.
void add_area_light(Element& shape, const TextureValue& radiance, const Location& place);

}  // namespace neumann::reader::tungsten
