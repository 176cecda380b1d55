// The statement of a study about a picture: which method is best at the largest budget, and by how much.
//
// The speed of a method is 1 / (MSE T), its merit: MSE T is the time that it takes to an MSE of 1 if errors fall as
// those of samples do. So the best one, a, is faster than b by the factor
//
//     ρ = MSE_b T_b / (MSE_a T_a)
//
// The intervals of all pairs of methods hold together at 95% (Bonferroni), because the best one was not known before. A
// difference is significant if its interval does not contain 1.
#pragma once

#include "operators/experiments/study/ratio_interval.h"
#include "operators/experiments/study/study_points.h"

namespace neumann {

struct SpeedRatio {
    std::size_t method;
    RatioInterval times;
    bool is_known = true;  // false if its variance is infinite

    bool is_seen() const { return is_known && times.low > 1.0; }
};

struct StudyVerdict {
    std::size_t best = 0;
    bool is_known = true;            // false if the variance of the best one is infinite
    std::vector<SpeedRatio> others;  // in order of rank
    // √bias² of the best one, if it is significant: samples alone do not get below this RMSE
    std::optional<double> own_error;
};

// `picture` has at least one method.
StudyVerdict verdict_on(const StudiedPicture& picture, std::size_t repeats);

}  // namespace neumann
