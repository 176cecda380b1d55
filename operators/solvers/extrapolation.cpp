#include "operators/solvers/extrapolation.h"

#include "operators/solvers/progress.h"

#include <fmt/format.h>

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
        if (trouble || !x.allFinite()) x = series.sum();
        const bool ended = largest(series.term()) == 0.0;
        const double change = ended ? 0.0 : trouble || last.size() == 0 ? infinity : largest(x - last) / largest(x);
        last = trouble ? Vector() : x;
        rate.add(largest(series.term()));
        steady = progress.reached(x, change) ? steady + 1 : 0;
        if (ended) return progress.end(series.sum(), Verdict::converged, fmt::format("term {} is 0", series.bounce()));
        if (steady >= wait) {
            progress.apply(x, residual);
            residual += problem.Le - x;
            const double unknown_rate = problem.radius || !(rate.rate() < 1.0) ? 1.0 : 1.0 / (1.0 - rate.rate());
            if (progress.reached(x, progress.from_residual(residual, x) * unknown_rate))
                return progress.end(x, Verdict::converged, "two limits agree, and the residual agrees with them");
            steady = 0;
            wait *= 2;
        }
        if (rate.not_falling())
            return progress.end(x, Verdict::refused, "the terms did not get smaller over the last 32 bounces: the series diverges");
        if (progress.exhausted()) return trouble ? progress.end(x, trouble->verdict, trouble->why) : progress.end_limit(x);
        series.advance();
        progress.count(1.0);
    }
}

}  // namespace neumann
