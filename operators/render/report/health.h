// The defects of a render, and where they are: samples that are not finite, fireflies, rays that hit the surface they
// leave, energy that is not conserved.
#pragma once

#include "operators/render/from_paths/rendered_series.h"
#include "operators/render/report/checkup.h"
#include "operators/render/report/remedy.h"

#include <optional>
#include <string>
#include <vector>

namespace neumann {

// A sample's share of its pixel's value, computed with the largest channels.
struct LargestShare {
    LargestSamples::Sample sample;
    double of_bounce = 0.0;  // share of the pixel's value of this bounce
    double of_sum = 0.0;     // share of the pixel's sum of all bounces and the rest
};

struct SampleHealth {
    std::uint64_t non_finite = 0;
    // Number of pixels whose samples are finite but whose mean overflows, and the first such pixel.
    std::uint64_t overflowed = 0;
    std::uint32_t first_overflowed = 0;
    // The sample with the largest share of its pixel among the 1000 largest samples of the picture; fireflies are preferred. None
    // if many samples are alike.
    std::optional<LargestShare> largest;
    // The number of these 1000 samples that are fireflies: the sample alone is more than half of its pixel's sum of all
    // bounces, adds more than the picture's mean to its pixel even if there were 256 samples, and adds more than a
    // quarter of the brightest pixel of this bounce (which samples at the edge of something bright do not). Bounce 0
    // and renders with fewer than 16 samples per pixel are not judged, because such samples are usual there.
    std::uint64_t fireflies = 0;
    // If there are fireflies: the remedies to try against the one in `largest`.
    std::vector<Remedy> remedies = {};
};
constexpr std::uint64_t fewest_samples_to_judge = 16;

struct Health {
    std::vector<SampleHealth> bounces;  // 0 … N and the rest
    std::vector<NonFiniteSample> first_non_finite;
    std::optional<Checkup> checkup;
    std::string why_no_checkup, why_no_balance;  // the reason in words, if there is none

    std::uint64_t non_finite() const;
    std::uint64_t overflowed() const;
    std::uint64_t fireflies() const;
    bool is_sick() const;
};

// Examines the render; traces some paths again (checkup.h). `result`: the result of the series' moments.
Health examine(const Scene& scene, const SamplingSettings& settings, const RenderedSeries& series,
               const SeriesMoments::Result& result);

}  // namespace neumann
