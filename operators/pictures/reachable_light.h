// Where light may be that samples do not show.
#pragma once

#include "core/image/image.h"
#include "core/scene/scene.h"

#include <cstdint>
#include <vector>

namespace neumann {

// For each pixel the largest albedo of what some rays through it meet; 0 where they see nothing that reflects. Of pixels that are
// not `wanted`, nothing. The same bits on any number of threads.
Image seen_albedo(const Scene& scene, const std::vector<char>& wanted, std::uint64_t seed);

// For each pixel the largest radiance of some points of lights that the camera sees there: those too small for rays to meet, too.
Image seen_lights(const Scene& scene, std::uint64_t seed);

}  // namespace neumann
