// Renders a scene under each of a projector's lights, and the forward series under all of them.
#pragma once

#include "core/base/warnings.h"
#include "operators/unbounce/projector_lights.h"
#include "operators/watch.h"

#include <vector>

namespace neumann {

struct LightRenders {
    std::vector<Estimate> pictures, direct;  // Σ K^i Le and K Le of each light
    std::vector<Estimate> forward;           // K^i Le under all lights, i = 1 … N, by random numbers of its own
    Warnings warnings;
    double seconds = 0.0;
};

struct LightSampling {
    int bounces = 6;             // N
    std::uint64_t samples = 64;  // a pixel and a light; the forward series has four times as many
    std::uint64_t seed = 0;
};

// By walks from the camera. `tell` is called with the number of lights that are done. Throws Stopped if `watch` stops it, and as
// render().
LightRenders render_lights(const ProjectorLights& projector, const LightSampling& sampling, const Watch& watch,
                           const std::function<void(std::size_t)>& tell);

}  // namespace neumann
