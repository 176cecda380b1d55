// The spectra that pbrt has by name.
#pragma once

#include "core/base/vec.h"

#include <optional>
#include <string>
#include <vector>

namespace neumann::reader::pbrt {

// Linear sRGB of luminance 1 of a standard illuminant, "stdillum-A" and the like. Colours outside sRGB have negative components.
std::optional<Rgb> illuminant(const std::string& name);

// The index of refraction at the sodium D line, 589.3 nm, of "glass-BK7" and the like.
std::optional<double> glass(const std::string& name);

// Of "metal-Cu-eta" and "metal-Cu-k" η and k of copper; the metal's name is that of core/image/colour/metals.h, if it is there.
struct MetalSpectrum {
    std::string metal;
    bool is_k;
    Rgb value;
};
std::optional<MetalSpectrum> metal(const std::string& name);

// All names, for messages.
const std::vector<std::string>& spectrum_names();

}  // namespace neumann::reader::pbrt
