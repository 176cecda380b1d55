// Learns the numbers of branches by place (place_ratios.h).
#pragma once

#include "core/scene/scene.h"
#include "operators/paths/walk/place_ratios.h"
#include "operators/watch.h"

#include <cstdint>

namespace neumann {

struct PlacePilot {
    PlaceRatios ratios;
    double rays = 0.0;           // of a path that branches so
    std::uint64_t all_rays = 0;  // cast by the pilot
};

// The film of `scene` gives the number of walks. Throws Stopped.
PlacePilot learn_place_ratios(const Scene& scene, int bounces, std::uint64_t seed, const Watch& watch = {});

}  // namespace neumann
