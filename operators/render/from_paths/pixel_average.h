// Averages the samples of one pixel in a replicate.
#pragma once

#include "operators/render/from_paths/tally.h"
#include "operators/statistics/sample_ranges.h"

#include <glm/glm.hpp>

#include <optional>
#include <span>
#include <vector>

namespace neumann {

struct PixelAverage {
    explicit PixelAverage(std::size_t quantities) : mean(quantities), low(quantities), high(quantities) {}
    std::vector<Rgb> mean, low, high;
};

// Writes the means of the samples into `average.mean` and adds the samples to the pixel's ranges and to the tally;
// samples that are not finite are recorded there and left out. `samples`: sample by sample, all quantities of each.
// `colors`: as SamplingSettings::colors.
void average(std::span<Rgb> samples, std::size_t size, std::uint32_t pixel, std::uint64_t replicate,
             const std::optional<glm::dmat3>& colors, PixelAverage& average, std::span<SampleRange> ranges, Tally& tally);

}  // namespace neumann
