// The sun's disc as seen from the ground, by Preetham, Shirley and Smits, A Practical Analytic Model for Daylight, SIGGRAPH 1999,
// appendix 1: the spectrum above the atmosphere times the transmittances of air (Rayleigh), aerosol (Ångström, β by the turbidity),
// ozone, mixed gases and water vapour.
#pragma once

#include "core/image/colour/spectrum_to_rgb.h"

namespace neumann {

// The mean angle that the sun subtends, in degrees, as Mitsuba has it.
inline constexpr double sun_angle = 0.5358;

// Radiance, W·m⁻²·sr⁻¹·nm⁻¹, the same all over the disc, from 380 to 750 nm. `turbidity`: at least 1. `elevation`: radians, at
// least 0.
SpectrumTable sun_spectrum(double turbidity, double elevation);

}  // namespace neumann
