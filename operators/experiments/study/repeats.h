// How many repeats the interval that is asked for takes.
//
// The mean of the MSE of R repeats, whose relative standard deviation is c, has the 95% interval ± t(R − 1) c / √R of itself, and
// the RMSE half of that.
#pragma once

#include "operators/experiments/study/study_method.h"

#include <vector>

namespace neumann {

// The fewest repeats, at least two, for a relative half width of the RMSE of `half_width` > 0.
std::size_t repeats_for(double deviation, double half_width);

// The largest c of the methods in the sum of the bounces, by eight short runs of each; that of a repeat of a larger budget is
// about as large. Nothing if it was stopped.
std::optional<double> deviation_of_repeats(const std::vector<StudyMethod>& methods, int bounces, std::uint64_t seed,
                                           const Scene& scene, const Pilot& pilot, const Watch& watch);

}  // namespace neumann
