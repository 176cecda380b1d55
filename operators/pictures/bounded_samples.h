// Is the variance finite, whatever the samples look like? It is where all of them stay below a bound.
//
// A path that draws its directions by the materials and hits a light is worth Le Π fs |cosθ| / pdf. Every factor is bounded: that
// is so for all of our materials, and tables of `guided` keep a share α of the material. A light that is asked for as well has,
// with a heuristic's weight, at most that worth: with p1 the density of asking and p2 that of hitting,
//
//     f/p1 · p1²/(p1² + p2²) ≤ f/(2 p2),     f/p1 · p1/(p1 + p2) ≤ f/p2,
//
// and so has each way of `bidirectional`, of which hitting the light is one (Veach 1997, 9.2 and 10.2).
#pragma once

#include "operators/pictures/sampling_settings.h"

namespace neumann {

// The samples of bounces 0 … N are known to be bounded. Where this is false nothing is known: 1/d² has no bound where a light that
// is only asked for, or a surface whose points are drawn, touches another, nor near a light without extent. Nothing is said of the
// rest.
bool samples_are_bounded(const Scene& scene, const SamplingSettings& settings);

}  // namespace neumann
