// The terms in pixels, by the operators of the regions (unbounce.h).
#pragma once

#include "operators/experiments/unbounce/unbounce.h"

namespace neumann {

// `differences`: for each channel, of merged regions from the regions' terms, a row a region and a column a term, or empty. Sets
// terms, picture and rest of what is unbounced so far.
void add_pixel_terms(const LightPictures& pictures, const Estimate* picture, bool with_direct,
                     const std::array<Eigen::MatrixXd, 3>& differences, const Watch& watch, Unbounced& result);

}  // namespace neumann
