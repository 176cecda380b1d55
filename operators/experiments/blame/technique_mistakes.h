// The pictures that a bidirectional path tracer makes if one kind of its techniques (s, t) is missing: s vertices of a
// path come from the light and t from the camera, and the other techniques keep their weights, those of multiple
// importance sampling (power heuristic).
#pragma once

#include "core/scene/scene.h"
#include "operators/experiments/blame/picture_mistakes.h"
#include "operators/watch.h"

#include <cstdint>
#include <vector>

namespace neumann {

// For each kind, a wrong picture of each of these ranges. Empty for a scene that our bidirectional method refuses.
std::vector<WrongPictures> without_techniques(const Scene& scene, const std::vector<BounceRange>& ranges, std::uint64_t samples,
                                              std::uint64_t seed, const Watch& watch = {});

}  // namespace neumann
