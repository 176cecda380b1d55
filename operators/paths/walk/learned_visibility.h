// Learns the visibility of the lights where walks ask for light, before the first sample: from the vertices of walks from the
// camera, a ray to a point of each light, or of some of many. After Vévoda, Kondapaneni, Křivánek, Bayesian Online Regression for
// Adaptive Direct Illumination Sampling, 2018, but of the visibility alone, and by a pilot.
#pragma once

#include "core/emitter/light_visibility.h"
#include "core/scene/scene.h"
#include "operators/watch.h"

#include <memory>

namespace neumann {

// The film of `scene` gives the number of walks. The same for all renders of a scene; null if it has no lights. Throws Stopped.
std::shared_ptr<const LightVisibility> learn_visibility(const Scene& scene, int bounces, const Watch& watch = {});

}  // namespace neumann
