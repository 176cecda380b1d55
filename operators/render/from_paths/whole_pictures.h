// Moments of replicates that are whole pictures, because their pixels share samples. The means over the picture are
// appended as one more pixel, whose spread gives the errors of means.
#pragma once

#include "operators/statistics/series_moments.h"
#include "operators/watch.h"

#include <functional>
#include <optional>
#include <vector>

namespace neumann {

// Adds all quantities of each pixel to `picture`, which is black. False if `watch` stopped it: the work is dropped.
using SamplePicture = std::function<bool(std::uint64_t replicate, std::vector<Rgb>& picture, const Watch& watch)>;

// The node of replicates first … first + count − 1, without ranges; see PictureSampler::run().
std::optional<MomentsNode> run_whole_pictures(std::uint64_t first, std::uint64_t count, std::size_t pixels, std::size_t quantities,
                                              const Watch& watch, std::vector<double> memory, const SamplePicture& sample);

}  // namespace neumann
