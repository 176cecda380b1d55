// For what is rendered ahead of the pictures themselves: a pilot, and first pictures to look at.
#pragma once

#include "core/sensor/sensor_options.h"
#include "operators/render/methods/goal.h"

namespace neumann {

// The same view on a film whose rendered part is at most `most` pixels wide and high.
Film small_film(const Film& film, int most);

// Rays that a render by the walk casts: two of a bounce where samples are given, ten million a second where seconds are.
// A render that is expected to cast fewer does without: a pilot takes some 15 million, first pictures less.
constexpr double rays_of_a_long_render = 3e7, rays_of_bounce = 2.0;
double expected_rays(const Goal& goal, const Film& film, int bounces);

}  // namespace neumann
