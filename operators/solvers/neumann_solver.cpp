#include "operators/algebra/term_series.h"
#include "operators/solvers/series_solvers.h"
#include "operators/solvers/solver_log.h"

#include <algorithm>

namespace neumann {

SolverResult solve_neumann(const Problem& problem) {
    SolverLog log(problem);
    TermSeries series(*problem.K, problem.Le);
    ChangeRate rate;
    Vector before_last;
    for (;;) {
        const Vector x = series.sum();
        const double term = log.largest(series.term());
        if (!log.all_finite(x)) return log.end_overflow(x, "the terms");
        rate.add(term);
        const double rounding = log.rounding(rate.rate()), tail = log.tail(series, before_last, x, rate);
        if (log.reached(x, term == 0.0 ? 0.0 : std::max(tail / log.largest(x), rounding)))
            return log.end(x, Verdict::converged, "the tail is " + log.found_tail(rate));
        if (log.is_rounding(tail, x)) return log.end_rounding(x, rounding);
        if (rate.not_falling() && log.diverges())
            return log.end_diverging(x, "the terms did not get smaller over the last 32 bounces");
        if (log.exhausted()) return log.end_limit(x);
        before_last = series.before();
        series.advance();
        log.count(1.0);
    }
}

}  // namespace neumann
