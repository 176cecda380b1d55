// The settings with which a path method samples a scene.
#pragma once

#include "operators/render/from_paths/sampling_settings.h"
#include "operators/render/methods/method.h"
#include "operators/render/methods/prepared.h"
#include "operators/render/plan/plan.h"
#include "operators/watch.h"

namespace neumann {

// Returns the settings without the bounces, the rest, the tables and the replicate size. Throws InputError if the
// method cannot render the scene.
SamplingSettings sampling_settings(const Method& method, const Scene& scene, const Plan& plan, std::uint64_t seed);

// Throws InputError if the scene's integrator hides emitters, which the method of this name cannot.
void expect_visible_emitters(const char* method, const Scene& scene);

// Prepares a method for its first sample, and the numbers of samples of --adaptive. Returns whether it needs any
// preparation. Throws InputError, and Stopped if `watch` stops it.
bool set_up(const Method& method, const Scene& scene, int bounces, double memory, SamplingSettings& settings, Prepared& prepared,
            const Watch& watch = {});

}  // namespace neumann
