// <rgb>, <spectrum>, <float> and <integer> as colours.
#pragma once

#include "core/base/warnings.h"
#include "core/reader/properties.h"
#include "core/spectrum/spectrum_to_rgb.h"

namespace neumann::reader {

// Not negative; throws InputError otherwise. A list of wavelengths is integrated as Mitsuba does in its RGB modes: a reflectance
// under D65, a radiance under equal energy, both cut to the colours of sRGB, and a reflectance to at most 1.
Rgb parse_color(Properties& p, const std::string& name, const Element& e, Illuminant illuminant, Warnings& warnings);
// η or k of a metal, channel by channel: a list of wavelengths is integrated under D65 and cut at 0 only.
Rgb parse_metal_index(Properties& p, const std::string& name, const Element& e, Warnings& warnings);

inline const std::vector<std::string> color_types = {"rgb", "spectrum", "float", "integer"};

}  // namespace neumann::reader
