// The methods among which `auto` chooses, and those that `mixed` mixes.
#pragma once

#include "operators/render/methods/method.h"

#include <vector>

namespace neumann {

struct Candidate {
    Method method;
    double price;  // the time of a ray in that of the walk's, measured on the scenes in scenes/
};

// Those that make the same paths in this scene, all that can be made, without a bias. The first is the plainest.
std::vector<Candidate> candidates(const method::PathOptions& options, const Scene& scene);
// Those that may be mixed: also those whose pixels share all paths.
std::vector<Candidate> mixture_candidates(const method::PathOptions& options, const Scene& scene);
// Those with a bias, which they state. Some scenes they refuse.
std::vector<Candidate> biased_candidates();

}  // namespace neumann
