// The number of repeats that a wanted interval takes.
//
// If the MSE of a repeat has the relative standard deviation c, the mean over R repeats has the relative 95% interval ±
// t(R − 1) c / √R, and the RMSE half of that.
#pragma once

#include "operators/experiments/study/study_method.h"

#include <vector>

namespace neumann {

// The fewest repeats, at least two, for a relative half width of the RMSE of `half_width` > 0.
std::size_t repeats_for(double deviation, double half_width);

// The largest c of the methods in the sum of the bounces, from eight short runs of each; c of a larger budget is about
// as large. Nothing if it was stopped.
std::optional<double> deviation_of_repeats(const std::vector<StudyMethod>& methods, int bounces, std::uint64_t seed,
                                           const Scene& scene, const Pilot& pilot, const Watch& watch);

}  // namespace neumann
