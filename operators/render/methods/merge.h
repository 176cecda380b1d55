// Renders of one scene become one: parts of the samples of one seed, or renders of different seeds.
#pragma once

#include "operators/render/methods/saving.h"

#include <string>
#include <vector>

namespace neumann {

struct NamedState {
    std::string name;  // for messages
    RenderState state;
};

// Parts that are consecutive replicates of one seed have the bits of the render of all of them. Of others every replicate counts
// the same, and their samples are renamed: replicates are numbered in the order of `renders`. The errors by samples are those after
// each of them. Throws InputError, with the names of two that do not go together, if methods, bounces, pictures or replicates are
// unlike, or if both have the same samples.
RenderState merge(std::vector<NamedState> renders);

}  // namespace neumann
