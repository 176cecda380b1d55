#include "operators/solvers/extrapolation.h"

#include "operators/solvers/progress.h"

#include <fmt/format.h>

#include <algorithm>

namespace neumann {

SolverResult solve_extrapolated(const Problem& problem, const Extrapolate& extrapolate) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Progress progress(problem);
    TermSeries series(*problem.K, problem.Le);
    ChangeRate rate;
    Vector x, last, residual;
    int steady = 0, wait = 2;
    for (;;) {
        std::optional<Trouble> trouble = extrapolate(series, x);
        const Vector sum = series.sum();
        if (trouble || !x.allFinite()) x = sum;
        const bool ended = largest(series.term()) == 0.0;
        const double change = ended ? 0.0 : trouble || last.size() == 0 ? infinity : largest(x - last) / largest(x);
        last = trouble ? Vector() : x;
        rate.add(largest(series.term()));
        steady = progress.reached(x, change) ? steady + 1 : 0;
        if (ended) return progress.end(sum, Verdict::converged, fmt::format("term {} is 0", series.bounce()));
        if (steady >= wait) {
            progress.apply(x, residual);
            residual += problem.Le - x;
            if (progress.reached(x, progress.from_residual(residual, x, rate.rate())))
                return progress.end(x, Verdict::converged, "two limits agree, and the residual agrees with them");
            steady = 0;
            wait *= 2;
        }
        // Even if the extrapolation fails, the terms themselves may have converged.
        const double rounding = progress.rounding(rate.rate());
        if (rate.estimate() <= problem.tolerance * largest(sum) &&
            progress.reached(sum, std::max(rate.estimate() / largest(sum), rounding)))
            return progress.end(sum, Verdict::converged,
                                fmt::format("the plain sum, its tail estimated from the rate {:.6g}; extrapolated: {}", rate.rate(),
                                            trouble ? trouble->why : "no two limits agree"));
        if (Progress::is_rounding(rate.estimate(), sum)) return progress.end_rounding(sum, rounding);
        if (rate.not_falling() && progress.diverges())
            return progress.end_diverging(x, "the terms did not get smaller over the last 32 bounces");
        if (progress.exhausted()) return trouble ? progress.end(x, trouble->verdict, trouble->why) : progress.end_limit(x);
        series.advance();
        progress.count(1.0);
    }
}

}  // namespace neumann
