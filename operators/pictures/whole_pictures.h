// Moments of replicates that are whole pictures, because their pixels share samples. The means over the picture follow as one more
// pixel, from whose spread the errors of means are taken.
#pragma once

#include "operators/pictures/sampling_settings.h"
#include "operators/statistics/series_moments.h"

#include <functional>
#include <optional>
#include <vector>

namespace neumann {

// Writes all quantities of each pixel of a replicate into `picture`, which has the size for that. Returns false if part_done(part)
// has returned true meanwhile: the work is dropped.
using SamplePicture =
    std::function<bool(std::uint64_t replicate, std::vector<Rgb>& picture, const std::function<bool(double)>& part_done)>;

// Replicates first … first + count − 1; see PictureSampler::run(). The node has no ranges.
std::optional<MomentsNode> run_whole_pictures(std::uint64_t first, std::uint64_t count, std::size_t pixels, std::size_t quantities,
                                              const PixelWatch& watch, std::vector<double> memory, const SamplePicture& sample);

}  // namespace neumann
