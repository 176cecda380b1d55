#include "operators/solvers/chebyshev.h"

#include "operators/solvers/solver_log.h"

#include <fmt/format.h>

namespace neumann {

SolverResult solve_chebyshev(const Problem& problem, double lowest, double highest) {
    SolverLog log(problem);
    if (!(lowest <= highest && highest < 1.0))
        return log.end(problem.Le, Verdict::refused,
                       fmt::format("needs lowest ≤ highest < 1 for the eigenvalues of K, not [{:.6g}, {:.6g}]", lowest, highest));
    // The eigenvalues of I − K are in centre ± half.
    const double centre = 1.0 - 0.5 * (lowest + highest), half = 0.5 * (highest - lowest);
    double c = half / centre;
    // The iteration starts from x = 0, whose residual is Le.
    Vector r = problem.Le, d = r / centre, x = d, Kd;
    double estimate = std::numeric_limits<double>::infinity();
    for (;;) {
        // The residual of this x takes one more application, so the estimate belongs to the previous iterate.
        if (log.reached(x, estimate)) return log.end(x, Verdict::converged, "by the residual");
        if (log.is_rounding(log.largest(r), x)) return log.end_rounding(x, estimate);
        if (log.exhausted()) return log.end_limit(x);
        log.apply(d, Kd);
        r -= d - Kd;
        estimate = log.from_residual(r, x);
        const double width = 2.0 * centre - half * c, next = half / width;
        d = next * c * d + 2.0 / width * r;
        c = next;
        x += d;
        if (!log.all_finite(x))
            return log.end(x, Verdict::broke_down, "eigenvalues outside of the interval made it grow without end");
    }
}

SolverResult solve_chebyshev(const Problem& problem) {
    if (!problem.radius) return SolverLog(problem).end(problem.Le, Verdict::refused, "needs the spectral radius");
    return solve_chebyshev(problem, problem.lowest.value_or(-*problem.radius), *problem.radius);
}

}  // namespace neumann
