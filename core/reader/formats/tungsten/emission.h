// What primitives emit.
#pragma once

#include "core/reader/formats/tungsten/textures.h"

namespace neumann::reader::tungsten {

// `power` times the radiance (or intensity) of a unit of power, or else `emission`; nothing where that is 0 or not there.
std::optional<TextureValue> find_emission(JsonObject& primitive, Textures& textures, double of_unit_power);

// Of a surface of this area.
double radiance_of_unit_power(double area);

// <emitter type="area"> in the shape.
void add_area_light(Element& shape, const TextureValue& radiance, const Location& place);

}  // namespace neumann::reader::tungsten
