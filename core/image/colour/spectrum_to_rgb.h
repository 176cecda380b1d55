// Spectra given as wavelength:value lists, as the linear sRGB colours that a renderer of three channels needs.
#pragma once

#include "core/base/vec.h"

#include <vector>

namespace neumann {

// Linear between the wavelengths, and zero outside. Wavelengths are in nm, increasing, and at least two.
struct SpectrumTable {
    std::vector<double> wavelengths, values;
};

// The light that is integrated with: XYZ = ∫ s w x̄ȳz̄ dλ / ∫ w ȳ dλ.
enum class Illuminant {
    equal_energy,  // w = 1: s is a radiance
    d65,           // w = D65, the white of sRGB: s is a reflectance, and s = 1 is white
};

// Linear sRGB of XYZ: Rec. 709 primaries, D65 white, without adaptation; the digits are those of ITU-R BT.709 as Mitsuba has them.
glm::dmat3 rgb_from_xyz();

// Linear sRGB of a radiance of which ∫ L x̄ȳz̄ dλ is given: divided by ∫ ȳ dλ, as Illuminant::equal_energy does.
Rgb radiance_to_rgb(const Vec3& xyz);

// Colours outside sRGB have negative components.
Rgb spectrum_to_rgb(const SpectrumTable& s, Illuminant illuminant);

// The inverse of the sRGB transfer function (IEC 61966-2-1), for encoded values in [0, 1].
double srgb_decode(double encoded);

}  // namespace neumann
