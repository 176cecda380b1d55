#include "operators/solvers/extrapolation.h"

#include "operators/solvers/solver_log.h"

#include <fmt/format.h>

#include <algorithm>

namespace neumann {

SolverResult solve_extrapolated(const Problem& problem, const Extrapolate& extrapolate) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    SolverLog log(problem);
    TermSeries series(*problem.K, problem.Le);
    ChangeRate rate;
    Vector x, last, residual, before_last;
    int steady = 0, wait = 2;
    for (;;) {
        std::optional<Trouble> trouble = extrapolate(series, x);
        const Vector sum = series.sum();
        if (trouble || !log.all_finite(x)) x = sum;
        const bool ended = log.largest(series.term()) == 0.0;
        const double change = ended ? 0.0 : trouble || last.size() == 0 ? infinity : log.largest(x - last) / log.largest(x);
        last = trouble ? Vector() : x;
        rate.add(log.largest(series.term()));
        steady = log.reached(x, change) ? steady + 1 : 0;
        if (ended) return log.end(sum, Verdict::converged, fmt::format("term {} is 0", series.bounce()));
        if (steady >= wait) {
            log.apply(x, residual);
            residual += problem.Le - x;
            if (log.reached(x, log.from_residual(residual, x, rate.rate())))
                return log.end(x, Verdict::converged, "two limits agree, and the residual agrees with them");
            steady = 0;
            wait *= 2;
        }
        // Even if the extrapolation fails, the terms themselves may have converged.
        const double rounding = log.rounding(rate.rate()), tail = log.tail(series, before_last, sum, rate);
        if (tail <= problem.tolerance * log.largest(sum) && log.reached(sum, std::max(tail / log.largest(sum), rounding)))
            return log.end(sum, Verdict::converged,
                           fmt::format("the plain sum, its tail {}; extrapolated: {}", log.found_tail(rate),
                                       trouble ? trouble->why : "no two limits agree"));
        if (log.is_rounding(tail, sum)) return log.end_rounding(sum, rounding);
        if (rate.not_falling() && log.diverges())
            return log.end_diverging(x, "the terms did not get smaller over the last 32 bounces");
        if (log.exhausted()) return trouble ? log.end(x, trouble->verdict, trouble->why) : log.end_limit(x);
        before_last = series.before();
        series.advance();
        log.count(1.0);
    }
}

}  // namespace neumann
