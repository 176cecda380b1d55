// The settings with which a path method samples a scene.
#pragma once

#include "operators/methods/method.h"
#include "operators/pictures/sampling_settings.h"
#include "operators/plan/plan.h"

#include <memory>

namespace neumann {

// Sets everything but the bounces, the rest, the tables and the replicate size. Throws InputError if the method cannot render the
// scene.
SamplingSettings sampling_settings(const Method& method, const Scene& scene, const Plan& plan, std::uint64_t seed);

// Builds the guide's tables. Throws InputError.
std::shared_ptr<const DirectionTables> direction_tables(const method::Guided& guided, const Scene& scene, int bounces,
                                                        std::uint64_t seed, double memory);

}  // namespace neumann
