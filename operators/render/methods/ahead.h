// What is rendered ahead of the pictures themselves: a pilot, and first pictures to look at.
#pragma once

#include "core/sensor/sensor_options.h"
#include "operators/render/methods/goal.h"

namespace neumann {

// The same view on a film whose rendered part is at most `most` pixels wide and high.
Film small_film(const Film& film, int most);

// An estimate of the rays that a render by the walk casts: two per bounce if samples are given, ten million a second if
// seconds are. A render that is expected to cast fewer than rays_of_a_long_render skips the pilot, which takes some 15
// million, and the first pictures, which take fewer.
constexpr double rays_of_a_long_render = 3e7, rays_of_bounce = 2.0;
double expected_rays(const Goal& goal, const Film& film, int bounces);

}  // namespace neumann
