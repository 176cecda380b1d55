// How a method that makes paths samples a scene.
#pragma once

#include "operators/methods/method.h"
#include "operators/pictures/sampling_settings.h"
#include "operators/plan/plan.h"

#include <memory>

namespace neumann {

// All but the bounces, the rest, the tables and the replicates. Throws InputError where the method cannot render the scene.
SamplingSettings sampling_settings(const Method& method, const Scene& scene, const Plan& plan, std::uint64_t seed);

// Of a guided method. Throws InputError.
std::shared_ptr<const DirectionTables> direction_tables(const method::Guided& guided, const Scene& scene, int bounces,
                                                        std::uint64_t seed, double memory);

}  // namespace neumann
