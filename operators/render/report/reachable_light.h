// Finds where there may be light that the samples missed.
#pragma once

#include "core/image/image.h"
#include "core/scene/scene.h"

#include <cstdint>
#include <vector>

namespace neumann {

// For each `wanted` pixel, the largest albedo of the surfaces that some rays through it hit, and the largest measured value of the
// light along these rays; 0 if no surface reflects or no ray finds light. The same bits on any number of threads.
struct SeenByRays {
    Image albedo, emitted;
};
SeenByRays seen_by_rays(const Scene& scene, const std::vector<char>& wanted, std::uint64_t seed);

// For each pixel, the largest measured value of sampled points on lights that the camera sees there. This finds lights that are too
// small for camera rays to hit.
Image seen_lights(const Scene& scene, std::uint64_t seed);

}  // namespace neumann
