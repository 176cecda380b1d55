// The settings with which a path method samples a scene.
#pragma once

#include "operators/render/from_paths/sampling_settings.h"
#include "operators/render/methods/method.h"
#include "operators/render/methods/prepared.h"
#include "operators/render/plan/plan.h"
#include "operators/watch.h"

namespace neumann {

// Sets everything but the bounces, the rest, the tables and the replicate size. Throws InputError if the method cannot render the
// scene.
SamplingSettings sampling_settings(const Method& method, const Scene& scene, const Plan& plan, std::uint64_t seed);

// With defaults for what is not given.
CacheSettings settings_of(const method::Cache& cache);

// Makes what a method needs before its first sample: the tables of `guided`, the fields of `corrected`, the radii of `photon`, the
// places of `cache`, the numbers of samples of --tree and --adaptive. Returns whether it needs anything. Throws InputError, and
// Stopped if `watch` stops it.
bool set_up(const Method& method, const Scene& scene, int bounces, double memory, SamplingSettings& settings, Prepared& prepared,
            const Watch& watch = {});

}  // namespace neumann
