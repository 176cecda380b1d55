// What is wrong with a render, and where: samples that are no numbers, single samples that make a pixel, rays that hit the surface
// they leave, energy that comes from nowhere.
#pragma once

#include "operators/pictures/checkup.h"
#include "operators/pictures/remedy.h"
#include "operators/pictures/rendered_series.h"

#include <optional>
#include <vector>

namespace neumann {

// A sample by what it makes of its pixel, in the largest channels.
struct LargestShare {
    LargestSamples::Sample sample;
    double of_bounce = 0.0;  // of all that its pixel has of this bounce
    double of_sum = 0.0;     // and of all bounces with the rest
};

// Of a bounce, or of the rest.
struct SampleHealth {
    std::uint64_t non_finite = 0;
    // Pixels whose mean is too large for a number although their samples are not, and the first of them.
    std::uint64_t overflowed = 0;
    std::uint32_t first_overflowed = 0;
    // Among the 1000 largest samples of the picture the one with the largest share of its pixel, fireflies before all others. None
    // where many are alike.
    std::optional<LargestShare> largest;
    // Among these, samples each of which makes more than half of its pixel's sum of all bounces, brings it, alone, more than the
    // mean of the picture, and a quarter of what the brightest pixel has of this bounce; at the edge of something bright a sample
    // that sees it does not. Neither bounce 0 is judged nor fewer than 16 samples a pixel: there it is usual.
    std::uint64_t fireflies = 0;
    // What else to try, if there are any; of the one that is named.
    std::vector<Remedy> remedies = {};
};
constexpr std::uint64_t fewest_samples_to_judge = 16;

struct Health {
    std::vector<SampleHealth> bounces;  // 0 … N and the rest
    std::vector<NonFiniteSample> first_non_finite;
    std::optional<Checkup> checkup;

    std::uint64_t non_finite() const;
    std::uint64_t overflowed() const;
    std::uint64_t fireflies() const;
    bool is_sick() const;
};

// `result`: of the series' moments. Traces some paths again (checkup.h).
Health examine(const Scene& scene, const SamplingSettings& settings, const RenderedSeries& series,
               const SeriesMoments::Result& result);

}  // namespace neumann
