#include "operators/experiments/study/verdict.h"

#include "operators/statistics/student_t.h"

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

// MSE T; the errors of both are independent.
WithError time_to_error(const PointSummary& point) {
    const double mse = std::max(point.mse.value, 0.0), seconds = point.seconds.value;
    return {mse * seconds, std::hypot(seconds * point.mse.standard_error, mse * point.seconds.standard_error)};
}

}  // namespace

StudyVerdict verdict_on(const StudiedPicture& picture, std::size_t repeats) {
    const StudiedMethod& best = picture.methods.front();
    const PointSummary& point = best.summary.points.back();
    StudyVerdict verdict{best.method, !best.summary.infinite_variance, {}, {}};
    if (point.biased) verdict.own_error = std::sqrt(point.bias_squared.value);
    const auto methods = static_cast<double>(picture.methods.size());
    const double pairs = std::max(methods * (methods - 1.0) / 2.0, 1.0);
    const double t = student_t_quantile(1.0 - 0.05 / pairs, static_cast<double>(repeats) - 1.0);
    for (std::size_t m = 1; m < picture.methods.size(); ++m) {
        const StudiedMethod& other = picture.methods[m];
        verdict.others.push_back({other.method, ratio_interval(time_to_error(other.summary.points.back()), time_to_error(point), t),
                                  verdict.is_known && !other.summary.infinite_variance});
    }
    return verdict;
}

}  // namespace neumann
