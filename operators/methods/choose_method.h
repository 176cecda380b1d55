// --method auto: which unbiased method promises least error for its cost in a scene.
#pragma once

#include "operators/methods/goal.h"
#include "operators/methods/method_choice.h"
#include "operators/watch.h"

namespace neumann {

// Renders a small picture with each method and compares their work for the same error: rays · Σ_i E|error of K^i Le|² / |K^i Le|²,
// i ≥ 1. Counts rays, not seconds, so that the same seed chooses the same method anywhere.
MethodChoice choose_method(const method::Auto& open, const Scene& scene, const Goal& goal, const Watch& watch);

}  // namespace neumann
