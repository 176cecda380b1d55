// The methods that a study compares if none is named: all that can render the scene.
#pragma once

#include "operators/experiments/study/study_method.h"

#include <vector>

namespace neumann {

struct MethodsForScene {
    std::vector<StudyMethod> methods;   // at least one
    std::vector<std::string> left_out;  // the messages of those that refuse the scene, which begin with their names
};

// All methods except auto and mixed, which consist of others, classic and shooting, which leave paths out, and pointwise, which is
// slow and a test of the others. Each is tried once. Throws InputError if none can render the scene. Returns nothing if it was
// stopped.
std::optional<MethodsForScene> methods_for_scene(int bounces, std::uint64_t seed, const Scene& scene, const Pilot& pilot,
                                                 const Watch& watch);

}  // namespace neumann
