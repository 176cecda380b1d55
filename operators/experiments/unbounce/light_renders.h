// Renders a scene under all of a projector's lights at once, and the forward series under all of them together.
//
// A walk from the camera asks the projector for light at each of its vertices. What it finds at a vertex comes from the block whose
// beam the vertex stands in, and from no other: so each find counts in the picture of that light, and one set of walks makes all
// pictures, each with the expectation and the variance of one that is rendered alone. Their errors go together, as their samples
// are the same; they are independent between parts of the samples, which are kept (RegionParts).
//
// The camera, which is where the projector is, sees the first vertex, and light counts as having bounced as often in the series
// backwards as it has been reflected by surfaces that the camera sees: Sⁿ. So light by way of surfaces that are not seen makes the
// terms backward Sⁿ in place of Kⁿ Le, however fine the lights.
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
    std::vector<Estimate> pictures;               // Σ K^i Le of each light
    Estimate direct;                              // K Le under all of them: that of a light on its block
    RegionParts parts;                            // of the pictures, by the lights' blocks
    std::vector<Estimate> forward;                // K^i Le under all lights, i = 1 … N, by random numbers of its own
    std::vector<MeanWithError> by_way_of_unseen;  // the mean of Sⁿ − Kⁿ Le, n = 1 … N
    Warnings warnings;
    double seconds = 0.0;

    Estimate direct_of(std::size_t light) const;
};

struct LightSampling {
    int bounces = 6;              // N
    std::uint64_t samples = 256;  // a pixel, for all lights together; the forward series has four times as many
    std::uint64_t seed = 0;
};

// By walks from the camera. `tell` is called with the part of the samples that is done. Throws Stopped if `watch` stops it, and as
// render().
LightRenders render_lights(const ProjectorLights& projector, const LightSampling& sampling, const Watch& watch,
                           const std::function<void(double)>& tell);

}  // namespace neumann
