// Reads <spectrum>: a value, a list wavelength:value, a file of such a list, or an object: `blackbody`, `d65`,
// `irregular`, `regular`, `uniform`.
#pragma once

#include "core/image/colour/spectrum_to_rgb.h"
#include "core/reader/xml/document.h"

namespace neumann::reader {

// In Mitsuba 3 <texture> and <spectrum> with a type are the same. Here what varies over a surface becomes a <texture>,
// and what does not a <spectrum>.
void take_textures_apart(Element& e);

// Replaces a spectrum given by a file or an object by its list or number, so that later code needs to handle <spectrum
// name value> and <float name value> only. A list that comes from `blackbody` keeps its type. A lenient reader takes an
// unknown type as 0.5, and as 0 in an emitter.
void write_out_spectrum(Element& e, const std::string& parent_tag, Document& document, Problems& problems);

// Reads a list such as "400:0.5, 500:0.75".
SpectrumTable parse_spectrum(const Attribute& a);
// The colour of a spectrum, cut to the gamut of sRGB and to the largest value, with a warning.
Rgb spectrum_within_srgb(const SpectrumTable& s, Illuminant illuminant, double largest, Warnings& warnings);

}  // namespace neumann::reader
