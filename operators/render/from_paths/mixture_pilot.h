// Finds how methods are best mixed in a scene.
#pragma once

#include "operators/render/from_paths/mixture.h"
#include "operators/render/from_paths/sampling_settings.h"
#include "operators/watch.h"

#include <string>
#include <vector>

namespace neumann {

// A method that may be a part of the mixture: all that it needs, and the time of its ray in that of the walk's.
struct MixtureCandidate {
    std::string name;
    SamplingSettings settings;
    double price = 1.0;
};

// Renders a small picture with each, `view` being the scene on a film of a quarter of its width and height, or so, with the same
// view, and mixes those that are worth it for the film of `scene`. A sample of the mixture has the work of one of the first
// candidate; where a single method is left, it is a sample of that, and pixels have the numbers that allocate() gives them. The
// same for all seeds of `settings`, but by guides and fields as their seed has made them. Throws Stopped if `watch` stops it.
Mixture mix(const Scene& scene, const Scene& view, const std::vector<MixtureCandidate>& candidates, LeastError least,
            const Watch& watch = {});

}  // namespace neumann
