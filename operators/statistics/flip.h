// ꟻLIP: how different two pictures look to someone who alternates between them, from 0 to 1.
//
//     LDR-FLIP  Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild, FLIP: A Difference Evaluator for Alternating
//               Images, 2020
//     HDR-FLIP  Andersson, Nilsson, Shirley and Akenine-Möller, Visualizing Errors in Rendered High Dynamic Range Images, 2021
//
// The HDR-FLIP of a pixel is its largest LDR-FLIP over exposures at intervals of about a stop, after the ACES tone
// curve: from the exposure at which the brightest pixel of the reference is nearly white to that at which its median
// is. A pixel is seen at 1/67 of a degree, as on a 4K monitor 0.7 m wide from 0.7 m.
#pragma once

#include "core/image/image.h"

#include <vector>

namespace neumann {

constexpr double flip_pixels_per_degree = 0.7 * 3840 / 0.7 * 3.14159265358979323846 / 180.0;

// LDR-FLIP of linear RGB from 0 to 1; returns a value for each pixel. Throws InputError if the sizes differ.
std::vector<float> ldr_flip(const Image& test, const Image& reference);

// HDR-FLIP of scene-linear pictures, in which negative values count as 0. The error of a pixel that is not finite is 1
// if it is so in one of the pictures, and 0 if in both; its neighbours see it as black. The median is that of the
// pixels that are not black. Throws InputError if the sizes differ.
std::vector<float> hdr_flip(const Image& test, const Image& reference);

// The mean of hdr_flip().
double mean_hdr_flip(const Image& test, const Image& reference);

}  // namespace neumann
