// <rgb>, <spectrum>, <float> and <integer> as colours.
#pragma once

#include "core/base/warnings.h"
#include "core/colour/spectrum_to_rgb.h"
#include "core/reader/xml/properties.h"

namespace neumann::reader {

// Not negative; otherwise it is a problem of the parameter, and black. Spectra are made colours as in Mitsuba's RGB modes: a list
// of wavelengths is integrated, a reflectance under D65, a radiance under equal energy, both cut to the colours of sRGB, and a
// reflectance to at most 1; a spectrum of one value is a grey reflectance, and a radiance of equal energy, which is not white.
// <rgb> and <float> are taken as they are.
Rgb parse_color(Properties& p, const std::string& name, const Element& e, Illuminant illuminant, Warnings& warnings);
// η or k of a metal, channel by channel: a list of wavelengths is integrated under D65 and cut at 0 only.
Rgb parse_metal_index(Properties& p, const std::string& name, const Element& e, Warnings& warnings);

inline const std::vector<std::string> color_types = {"rgb", "spectrum", "float", "integer"};

}  // namespace neumann::reader
