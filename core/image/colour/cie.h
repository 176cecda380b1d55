// CIE tables at 5 nm from 360 to 830 nm.
#pragma once

#include <array>

namespace neumann::cie {

inline constexpr double first_wavelength = 360.0, last_wavelength = 830.0, step = 5.0;  // nm
inline constexpr int count = 95;

// x̄, ȳ, z̄ of the CIE 1931 2° standard observer (CIE 15).
extern const std::array<std::array<double, 3>, count> observer_1931;
// Relative power of the standard illuminant D65 (CIE 15), 100 at 560 nm.
extern const std::array<double, count> illuminant_d65;

}  // namespace neumann::cie
