// Camera rays of all pixels, for code that estimates light along them.
#pragma once

#include "core/scene/camera_sample.h"
#include "operators/paths/walk/path_group.h"

#include <cstdint>
#include <vector>

namespace neumann {

struct CameraRays {
    std::vector<CameraRay> rays;
    std::vector<Pixel> pixels;
    std::vector<double> weights;  // weight of the film's filter, times the sensor's response
};

// The rays of samples first … first + count − 1 of every pixel: sample by sample, and in each of them row by row.
CameraRays camera_rays(const Scene& scene, std::uint64_t first, std::uint64_t count, std::uint64_t seed);

}  // namespace neumann
