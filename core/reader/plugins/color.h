// Reads <rgb>, <spectrum>, <float> and <integer> as colours.
#pragma once

#include "core/base/warnings.h"
#include "core/image/colour/spectrum_to_rgb.h"
#include "core/reader/xml/properties.h"

namespace neumann::reader {

// A negative colour is a problem of the parameter and gives black. Spectra become colours as in Mitsuba's RGB modes: a list of
// wavelengths is integrated, a reflectance under D65 and a radiance under equal energy; both are clipped to the gamut of sRGB, and
// a reflectance to at most 1. A spectrum of one value is a grey reflectance, or a radiance of equal energy, which is not white.
// <rgb> and <float> are used unchanged.
Rgb parse_color(Properties& p, const std::string& name, const Element& e, Illuminant illuminant, Warnings& warnings);
// Reads η or k of a metal, channel by channel: a list of wavelengths is integrated under D65, and only clipped at 0.
Rgb parse_metal_index(Properties& p, const std::string& name, const Element& e, Warnings& warnings);

inline const std::vector<std::string> color_types = {"rgb", "spectrum", "float", "integer"};

}  // namespace neumann::reader
