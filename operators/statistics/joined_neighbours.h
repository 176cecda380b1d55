// A noisy picture made fit for looking at: a pixel becomes a weighted mean of its neighbours whose values agree with its own, by
// Welch's test of both errors. Biased, for what agrees need not be equal, so it is for previews alone.
// (Sakai et al., A Statistical Approach to Monte Carlo Denoising, SIGGRAPH Asia 2024.)
#pragma once

#include "core/image/image.h"

namespace neumann {

// The means. Those of a picture without degrees of freedom are returned as they are.
Image joined_neighbours(const Estimate& picture);

}  // namespace neumann
