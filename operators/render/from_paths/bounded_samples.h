// Proves that the variance is finite, whatever the samples look like: it is if all samples are bounded.
//
// A path that samples the BSDFs and hits a light contributes Le Π fs |cosθ| / pdf. Every factor is bounded for all of our
// materials that have a largest albedo (two variants of Ward's have none), and the tables of `guided` mix in the BSDF with a share
// α. A light sample with the weight of the power or the balance heuristic has the same bound: with p1 the pdf of light sampling and
// p2 that of BSDF sampling,
//
//     f/p1 · p1²/(p1² + p2²) ≤ f/(2 p2),     f/p1 · p1/(p1 + p2) ≤ f/p2,
//
// and so has each strategy of `bidirectional`, one of which hits the light (Veach 1997, 9.2 and 10.2).
#pragma once

#include "operators/render/from_paths/sampling_settings.h"

namespace neumann {

// True if the samples of bounces 0 … N are proven to be bounded; false proves nothing. 1/d² is unbounded if light samples alone
// find a light that touches a surface, if vertices are sampled on surfaces that touch, and near a light without extent.
bool samples_are_bounded(const Scene& scene, const SamplingSettings& settings);

// True if the variance of the rest is finite as well, provided that the series converges. In the rest all methods
// sample the BSDFs, and roulette keeps the weight of a path constant: a sample is at most proportional to the number of
// bounces that its path survives, which falls off exponentially. (Single weights w above 1, as mixtures of lobes have,
// change nothing while E[w max(w, 1)] < 1.) Only roulette with a fixed survival q lets weights grow, and needs ρ² < q.
bool rest_has_finite_variance(const Scene& scene, const SamplingSettings& settings);

}  // namespace neumann
