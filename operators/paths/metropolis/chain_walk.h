// The states of one chain, for inspection.
#pragma once

#include "core/scene/scene.h"
#include "operators/watch.h"

#include <cstdint>
#include <vector>

namespace neumann {

struct ChainState {
    Vec2 position;          // on the film, pixels from its upper left corner
    int s = 0;              // number of vertices from the light among the bounce + 2 of the path
    double size = 0.0;      // f, the mean channel of its contribution, as a pixel's radiance times the number of pixels
    bool is_new = true;     // false if the step to it was rejected, so that the previous state is repeated
    bool by_large = false;  // whether the step drew all numbers anew
};

// Returns `states` states of a chain of bounce `bounce` ≥ 1, the first drawn from 65536 independent paths. Throws
// InputError if none of these brings light of this bounce, and Stopped.
std::vector<ChainState> chain_walk(const Scene& scene, int bounce, std::uint32_t states, std::uint64_t seed,
                                   const Watch& watch = {});

}  // namespace neumann
