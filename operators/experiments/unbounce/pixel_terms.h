// Computes the terms in pixels, by the operators of the regions (unbounce.h).
#pragma once

#include "operators/experiments/unbounce/unbounce.h"

namespace neumann {

// Sets terms, picture and rest of `result`. `differences`: for each channel, the differences of merged regions from the
// regions' terms, with a row for each region and a column for each term; or empty.
void add_pixel_terms(const LightPictures& pictures, const Estimate* picture, bool with_direct,
                     const std::array<Eigen::MatrixXd, 3>& differences, const Watch& watch, Unbounced& result);

}  // namespace neumann
