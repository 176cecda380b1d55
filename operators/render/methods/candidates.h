// The methods among which `auto` chooses, and those that `mixed` mixes.
#pragma once

#include "operators/render/methods/method.h"

#include <vector>

namespace neumann {

struct Candidate {
    Method method;
    double price;  // the time of a ray relative to a ray of the walk, measured on the scenes in scenes/
};

// The unbiased methods that make all paths in this scene that can be made. The first is the plainest.
std::vector<Candidate> candidates(const method::PathOptions& options, const Scene& scene);
// The methods that may be mixed: the candidates, and those whose pixels share all paths.
std::vector<Candidate> mixture_candidates(const method::PathOptions& options, const Scene& scene);
// The methods with a bias, which they state. They refuse some scenes.
std::vector<Candidate> biased_candidates();

}  // namespace neumann
