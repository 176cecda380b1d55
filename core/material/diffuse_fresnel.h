// The diffuse Fresnel reflectance: the fraction of uniform incident light that a smooth dielectric boundary reflects,
//
//     2 ∫₀¹ F(μ) μ dμ,   F for the refractive index n of the far side divided by that of the near side.
#pragma once

namespace neumann {

// Accurate to 1e-10 for 1.01 < n < 10. For n < 1 it is 1 − F̄(n) = n² (1 − F̄(1/n)), by reciprocity.
double diffuse_fresnel(double n);
// The fits that Mitsuba defines its plastics with: Egan and Hilgeman, Optical Properties of Inhomogeneous Materials, 1979, for n <
// 1, within 0.6% up to 1/n = 2; d'Eon and Irving, A Quantized-Diffusion Model for Rendering Translucent Materials, 2011, for n ≥ 1.
double fitted_diffuse_fresnel(double n);

}  // namespace neumann
