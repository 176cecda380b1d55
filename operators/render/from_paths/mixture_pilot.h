// Finds the best mixture of methods for a scene.
#pragma once

#include "operators/render/from_paths/mixture.h"
#include "operators/render/from_paths/sampling_settings.h"
#include "operators/watch.h"

#include <string>
#include <vector>

namespace neumann {

// A method that may be a part of the mixture, and the time of its ray relative to a ray of the walk.
struct MixtureCandidate {
    std::string name;
    SamplingSettings settings;
    double price = 1.0;
};

// Renders a small picture with each candidate and mixes those that are worth it for the film of `scene`. `view`: the same view on a
// film of about a quarter of its width and height. A sample of the mixture has the work of a sample of the first candidate. If a
// single method is left, it is a sample of that one, and pixels have the numbers that allocate() gives them. The result is the same
// for all seeds of `settings`, except that the seed makes guides and fields. Throws Stopped if `watch` stops it.
Mixture mix(const Scene& scene, const Scene& view, const std::vector<MixtureCandidate>& candidates, LeastError least,
            const Watch& watch = {});

}  // namespace neumann
