// The places where the errors of several methods against a reference differ most from each other.
#pragma once

#include "operators/experiments/study/picture_errors.h"

#include <functional>
#include <vector>

namespace neumann {

// Pixels x … x + width − 1, y … y + height − 1.
struct Crop {
    int x = 0, y = 0, width = 0, height = 0;
    bool operator==(const Crop&) const = default;
};

Image cropped(const Image& picture, const Crop& crop);
Estimate cropped(const Estimate& picture, const Crop& crop);

// √ max(0, mean over repeats (x − r̂)² − v) of each pixel and channel: v, the variance of the reference, is subtracted.
Image error_map(std::size_t repeats, const std::function<Image(std::size_t)>& picture, const Estimate& reference);

// At most `count` squares, of a sixth of the shorter side but at least 8 pixels (or the whole side), that do not overlap, largest
// differences first. The difference of a square is the sum over its pixels, with e_m the error map of method m, of
//
//     max_m q_m − min_m q_m,   q_m = √ Σ_c e_m² / (r̂² + ε ⟨r̂²⟩)        for one method q itself
//
// as relMSE weighs errors (metrics.h). Empty if nothing differs.
std::vector<Crop> differing_places(const std::vector<Image>& error_maps, const Image& reference, std::size_t count);

}  // namespace neumann
