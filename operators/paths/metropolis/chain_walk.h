// The walk of one chain, to look at.
#pragma once

#include "core/scene/scene.h"
#include "operators/watch.h"

#include <cstdint>
#include <vector>

namespace neumann {

struct ChainState {
    Vec2 position;          // on the film, pixels from its upper left corner
    int s = 0;              // vertices from the light, of the bounce + 2 that the path has
    double size = 0.0;      // f, the mean channel of what it brings, as a pixel's radiance times the number of pixels
    bool is_new = true;     // false where the step to it was refused, so that it is the state before once more
    bool by_large = false;  // whether the step drew all numbers anew
};

// `states` states of a chain of bounce `bounce` ≥ 1, the first drawn from 65536 independent paths. Throws InputError if none of
// these brings light of this bounce, and Stopped.
std::vector<ChainState> chain_walk(const Scene& scene, int bounce, std::uint32_t states, std::uint64_t seed,
                                   const Watch& watch = {});

}  // namespace neumann
