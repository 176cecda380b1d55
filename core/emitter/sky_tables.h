// The tables of the sky model in sky_model.h, which its authors fitted to path-traced skies, for CIE XYZ.
#pragma once

namespace neumann::sky {

inline constexpr int channels = 3, albedos = 2, turbidities = 10, elevations = 6, coefficients = 9;

// Tables by channel X, Y, Z, albedo of the ground 0 and 1, turbidity 1 to 10 and control point over the sun's elevation.
// A, B, C, D, E, F, G, I, H, in this order:
extern const double distribution[channels][albedos][turbidities][elevations][coefficients];
// M in W·m⁻²·sr⁻¹, ∫ L x̄ȳz̄ dλ.
extern const double mean_radiance[channels][albedos][turbidities][elevations];

}  // namespace neumann::sky
