// What else to try where a sample makes a pixel alone. Its path tells: which of its reflections are by a delta (a mirror, glass, a
// hole), where no other way to make the path can take its place.
#pragma once

#include "operators/pictures/picture_sampler.h"

#include <vector>

namespace neumann {

enum class Remedy {
    ask_lights,     // the walk with multiple importance sampling: the light was found from a point that could have asked for it
    bidirectional,  // two neighbours on the path, or the camera and its first point, can be joined: behind a delta, lights find
                    // more of such paths than chance does
    more_bounces    // the rest is made from the camera alone
};

// Of a sample of a quantity, bounces 0 … N and the rest: what the scene and the path allow. Together, where there are several.
// Empty where no method makes such a path but by chance.
std::vector<Remedy> remedies(const Scene& scene, const PictureSampler& sampler, const SampleName& name, std::size_t quantity);

}  // namespace neumann
