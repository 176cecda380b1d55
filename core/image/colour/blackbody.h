// Planck's law.
#pragma once

#include <cmath>

namespace neumann {

// The radiance of a black body at a wavelength in nm, of a temperature in K: W·m⁻²·sr⁻¹·nm⁻¹. The constants are exact since the SI
// of 2019.
inline double blackbody_radiance(double wavelength, double temperature) {
    constexpr double h = 6.62607015e-34, c = 299792458.0, k = 1.380649e-23;
    const double metres = wavelength * 1e-9;
    return 1e-9 * 2.0 * h * c * c / (std::pow(metres, 5.0) * std::expm1(h * c / (metres * k * temperature)));
}

}  // namespace neumann
