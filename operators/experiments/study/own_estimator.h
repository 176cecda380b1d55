// A method from outside the program: an estimator of the terms along camera rays, K^i Le(ray) = E[sample of bounce i].
#pragma once

#include "core/scene/camera_sample.h"
#include "operators/paths/walk/path_group.h"
#include "operators/render/methods/bounce_series.h"
#include "operators/watch.h"

#include <functional>
#include <span>
#include <vector>

namespace neumann {

// Returns samples of bounces 0 … N of each ray, all of a ray together. The seed differs in each call.
using OwnEstimator = std::function<std::vector<Rgb>(std::span<const CameraRay> rays, std::span<const Pixel> pixels, int bounces,
                                                    std::uint64_t seed)>;

// The means over `samples` of each pixel, as a study compares them: pictures without errors, with camera rays as the
// only rays. Throws InputError if the estimator returns values that are not finite.
BounceSeries render_by_own(const OwnEstimator& estimator, const Scene& scene, std::uint64_t samples, int bounces,
                           std::uint64_t seed, const Watch& watch);

}  // namespace neumann
