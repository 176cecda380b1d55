// The Neumann series backwards: pictures of a scene under separate lights, taken apart into bounces (cancellation.h).
//
// A pixel p is unbounced with the operators of the regions, with its row T_p of pictures and y = T⁻¹ Cⁿ⁻¹ L of the regions:
//
//     (C¹ L)_p = T¹_p T⁻¹ L,    (Cⁿ L)_p = (T_p − T¹_p) y,    T¹_pr = Σ_j T_pj (T⁻¹)_jr / (T⁻¹)_rr  for its region r, and 0 for
//     others,
//
// The means of these over a region are the region's terms.
#pragma once

#include "core/image/pixel_estimate.h"
#include "operators/experiments/unbounce/regions.h"
#include "operators/experiments/unbounce/unbounced_channel.h"
#include "operators/statistics/picture_statistics.h"
#include "operators/watch.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace neumann {

struct UnbounceSettings {
    int bounces = 6;  // N
    std::optional<double> regularisation = {};
    bool with_direct = false;  // take T¹ from the direct pictures in place of T⁻¹
    // For each light, its number among fewer, merged ones, to estimate the error due to the size of regions.
    std::vector<int> merged = {};
    std::uint64_t seed = 0;
};

struct Unbounced {
    Regions regions;
    bool knows_errors = false;
    double degrees_of_freedom = 0.0;  // of the errors
    std::array<UnbouncedChannel, 3> channels;
    // Cⁿ L, n = 1 … N, in pixels. The error of a pixel is that of its own values, to first order, and of its region's term. Errors
    // of pixels are correlated; those of means are from repeats. The discretisation is the difference from merged regions.
    std::vector<PixelEstimate> terms;
    std::vector<PictureMeans> means;
    // For the mean of term n, |difference| from merged regions; empty: not estimated.
    std::vector<double> discretisation;
    Image picture, rest;                // L, and L minus the sum of the terms
    RegionMeans pictures;               // T
    std::optional<RegionMeans> direct;  // T¹, if there are direct pictures

    int bounces() const { return static_cast<int>(terms.size()); }
    std::size_t lights() const { return static_cast<std::size_t>(pictures.mean[0].cols()); }
};

// Unbounces a picture. Pixels that are black under all lights are in no region. `picture`: of the same scene under any
// mixture of these lights; null: under all of them together. Throws InputError if there are fewer than two lights, as
// checked_picture() does, if the sizes differ, if all is black, and if T⁻¹ is infinite; Stopped.
Unbounced unbounce(const LightPictures& pictures, const Regions& regions, const Estimate* picture, const UnbounceSettings& settings,
                   const Watch& watch = {});

}  // namespace neumann
