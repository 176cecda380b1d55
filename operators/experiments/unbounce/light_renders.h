// Renders a scene under all of a projector's lights at once, and the forward series under all of them together.
//
// A walk from the camera takes a light sample of the projector at each of its vertices. The light at a vertex comes from the block
// whose beam contains the vertex, and from no other, so it counts in the picture of that light. One set of walks thus makes all
// pictures, each with the expectation and the variance of one that is rendered alone. Their errors are correlated, because they
// share samples; they are independent between parts of the samples, which are kept (RegionParts).
//
// The camera, which is at the projector's place, sees the first vertex. In the backward series the bounces of light are
// the reflections by surfaces that the camera sees: Sⁿ. So because of light by way of surfaces that are not seen, the
// backward terms are Sⁿ instead of Kⁿ Le, however fine the lights.
#pragma once

#include "core/base/warnings.h"
#include "operators/experiments/unbounce/projector_lights.h"
#include "operators/experiments/unbounce/regions.h"
#include "operators/statistics/picture_statistics.h"
#include "operators/watch.h"

#include <functional>
#include <vector>

namespace neumann {

struct LightRenders {
    std::vector<Estimate> pictures;               // for each light, Σ K^i Le
    Estimate direct;                              // K Le under all lights: within a block it is that of its light
    RegionParts parts;                            // parts of the pictures, with the lights' blocks as regions
    std::vector<Estimate> forward;                // K^i Le under all lights, i = 1 … N, with random numbers of its own
    std::vector<MeanWithError> by_way_of_unseen;  // the mean of Sⁿ − Kⁿ Le, n = 1 … N
    Warnings warnings;
    double seconds = 0.0;

    Estimate direct_of(std::size_t light) const;
};

struct LightSampling {
    int bounces = 6;              // N
    std::uint64_t samples = 256;  // of a pixel, for all lights together; the forward series has four times as many
    std::uint64_t seed = 0;
};

// Renders by walks from the camera. `tell` is called with the finished part of the samples. Throws Stopped if `watch`
// stops it, and the exceptions of render().
LightRenders render_lights(const ProjectorLights& projector, const LightSampling& sampling, const Watch& watch,
                           const std::function<void(double)>& tell);

}  // namespace neumann
