// Merges renders of one scene into one: parts of the samples of one seed, or renders of different seeds.
#pragma once

#include "operators/render/methods/saving.h"

#include <string>
#include <vector>

namespace neumann {

struct NamedState {
    std::string name;  // used in messages
    RenderState state;
};

// If all are consecutive replicates of one seed, the result has the bits of one render of all of them. Otherwise every
// replicate counts the same, and samples are renamed: replicates are numbered in the order of `renders`. The
// convergence has the errors after each render. Throws InputError, naming two renders that do not go together, if
// methods, bounces, pictures or replicates are unlike, or if both have the same samples.
RenderState merge(std::vector<NamedState> renders);

}  // namespace neumann
