#include "operators/series/term_series.h"
#include "operators/solvers/progress.h"
#include "operators/solvers/series_solvers.h"

#include <fmt/format.h>

namespace neumann {

SolverResult solve_neumann(const Problem& problem) {
    Progress progress(problem);
    TermSeries series(*problem.K, problem.Le);
    ChangeRate rate;
    for (;;) {
        const Vector x = series.sum();
        const double term = largest(series.term());
        if (!x.allFinite()) return progress.end(x, Verdict::diverging, "the terms grew until they were not finite");
        rate.add(term);
        if (progress.reached(x, term == 0.0 ? 0.0 : rate.estimate() / largest(x)))
            return progress.end(x, Verdict::converged, fmt::format("the tail is estimated from the rate {:.6g}", rate.rate()));
        if (rate.not_falling())
            return progress.end(x, Verdict::diverging, "the terms did not get smaller over the last 32 bounces");
        if (progress.exhausted()) return progress.end_limit(x);
        series.advance();
        progress.count(1.0);
    }
}

}  // namespace neumann
