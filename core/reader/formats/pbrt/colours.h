// Reads colours, "rgb", "blackbody" and "spectrum", of what reflects and of what emits.
#pragma once

#include "core/base/vec.h"
#include "core/image/colour/spectrum_to_rgb.h"
#include "core/reader/formats/pbrt/importer.h"

#include <optional>

namespace neumann::reader::pbrt {

// A reflectance, from 0 to 1; a spectrum is seen under D65, the white of sRGB.
std::optional<Rgb> find_reflectance(Parameters& p, const std::string& name, Importer& importer);

// The colour of a light. An rgb is taken as it is. Of spectra and black bodies only the colour counts, at luminance 1,
// as in pbrt: scale, power and illuminance set the brightness.
std::optional<Rgb> find_light_colour(Parameters& p, const std::string& name, Importer& importer);

// The index of refraction of a dielectric: a number, or that of a glass at 587.6 nm, with a warning that the glass does
// not disperse light.
std::optional<double> find_index(Parameters& p, const std::string& name, Importer& importer);

// η or k of a metal given by numbers; metals.h has those given by name.
std::optional<Rgb> find_metal_index(Parameters& p, const std::string& name, Importer& importer);

// A spectrum given by pairs of numbers or in a file. Nothing if the parameter is not given so.
std::optional<SpectrumTable> find_table(Parameters& p, const std::string& name, Importer& importer);

}  // namespace neumann::reader::pbrt
