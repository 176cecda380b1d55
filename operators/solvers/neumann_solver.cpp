#include "operators/solvers/progress.h"
#include "operators/solvers/series_solvers.h"
#include "operators/solvers/term_series.h"

#include <fmt/format.h>

#include <algorithm>

namespace neumann {

SolverResult solve_neumann(const Problem& problem) {
    Progress progress(problem);
    TermSeries series(*problem.K, problem.Le);
    ChangeRate rate;
    for (;;) {
        const Vector x = series.sum();
        const double term = largest(series.term());
        if (!x.allFinite()) return progress.end_overflow(x, "the terms");
        rate.add(term);
        const double rounding = progress.rounding(rate.rate());
        if (progress.reached(x, term == 0.0 ? 0.0 : std::max(rate.estimate() / largest(x), rounding)))
            return progress.end(x, Verdict::converged, fmt::format("the tail is estimated from the rate {:.6g}", rate.rate()));
        if (Progress::is_rounding(rate.estimate(), x)) return progress.end_rounding(x, rounding);
        if (rate.not_falling() && progress.diverges())
            return progress.end_diverging(x, "the terms did not get smaller over the last 32 bounces");
        if (progress.exhausted()) return progress.end_limit(x);
        series.advance();
        progress.count(1.0);
    }
}

}  // namespace neumann
