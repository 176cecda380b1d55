// The spectra that pbrt has by name.
#pragma once

#include "core/base/vec.h"

#include <optional>
#include <string>
#include <vector>

namespace neumann::reader::pbrt {

// The linear sRGB colour, at luminance 1, of a standard illuminant such as "stdillum-A". Colours outside sRGB have
// negative components.
std::optional<Rgb> illuminant(const std::string& name);

// The index of refraction at 587.6 nm of a glass such as "glass-BK7".
std::optional<double> glass(const std::string& name);

// The η or k of a metal: "metal-Cu-eta" and "metal-Cu-k" are those of copper. The metal's name is that of
// core/image/colour/metals.h, if it is there.
struct MetalSpectrum {
    std::string metal;
    bool is_k;
    Rgb value;
};
std::optional<MetalSpectrum> metal(const std::string& name);

// All names, for messages.
const std::vector<std::string>& spectrum_names();

}  // namespace neumann::reader::pbrt
