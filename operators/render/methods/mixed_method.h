// What --method mixed needs before its first sample.
#pragma once

#include "operators/render/from_paths/mixture.h"
#include "operators/render/from_paths/sampling_settings.h"
#include "operators/render/methods/method.h"
#include "operators/watch.h"

namespace neumann {

// `settings`: those of the mixture, with bounces and seed. Throws Stopped if `watch` stops it.
Mixture make_mixture(const method::Mixed& mixed, const Scene& scene, const SamplingSettings& settings, double memory,
                     const Watch& watch);

}  // namespace neumann
