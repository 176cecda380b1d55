// Colours: "rgb", "blackbody" and "spectrum", of what reflects and of what gives off light.
#pragma once

#include "core/base/vec.h"
#include "core/image/colour/spectrum_to_rgb.h"
#include "core/reader/formats/pbrt/importer.h"

#include <optional>

namespace neumann::reader::pbrt {

// A reflectance, from 0 to 1; a spectrum is seen under D65, the white of sRGB.
std::optional<Rgb> find_reflectance(Parameters& p, const std::string& name, Importer& importer);

// What a light gives off. An rgb is taken as it is; of spectra and black bodies only the colour counts, with the luminance 1, as in
// pbrt: scale, power and illuminance set how bright they are.
std::optional<Rgb> find_light_colour(Parameters& p, const std::string& name, Importer& importer);

// An index of refraction of a dielectric: a number or a glass, at 589 nm, with a warning that it does not disperse light.
std::optional<double> find_index(Parameters& p, const std::string& name, Importer& importer);

// η or k of a metal that is given by numbers; those by name are in metals.h.
std::optional<Rgb> find_metal_index(Parameters& p, const std::string& name, Importer& importer);

// A spectrum by pairs of numbers, or in a file. Null if the parameter is not given so.
std::optional<SpectrumTable> find_table(Parameters& p, const std::string& name, Importer& importer);

}  // namespace neumann::reader::pbrt
