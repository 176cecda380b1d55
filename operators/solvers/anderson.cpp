#include "operators/solvers/anderson.h"

#include "operators/solvers/solver_log.h"

#include <Eigen/QR>

#include <algorithm>

namespace neumann {

SolverResult solve_anderson(const Problem& problem, int m) {
    SolverLog log(problem);
    const Eigen::Index n = problem.Le.size(), columns = std::max(1, m);
    const Vector weight = log.K().measure().cwiseSqrt();
    Eigen::MatrixXd df(n, columns), dg(n, columns);  // df weighted
    Eigen::Index kept = 0, next = 0;
    Vector x = problem.Le, g(n), f(n), last_g, last_f;
    ChangeRate rate;
    for (;;) {
        log.apply(x, g);
        g += problem.Le;
        f = g - x;
        const double estimate = log.from_residual(f, x);
        rate.add(log.largest(f));
        const bool rounding = log.is_rounding(log.largest(f), x, !rate.not_falling());
        Vector weighted = weight.cwiseProduct(f);
        if (last_f.size() != 0) {
            df.col(next) = weighted - last_f;
            dg.col(next) = g - last_g;
            next = (next + 1) % columns;
            kept = std::min(kept + 1, columns);
        }
        last_f = weighted;
        last_g = g;
        x = g;
        if (kept > 0) {
            const Vector gamma = df.leftCols(kept).colPivHouseholderQr().solve(weighted);
            x -= dg.leftCols(kept) * gamma;
        }
        if (!log.all_finite(x)) return log.end(x, Verdict::broke_down, "values that are not finite");
        // The estimate belongs to the previous iterate: the residual of this one is not known yet.
        if (log.reached(x, estimate)) return log.end(x, Verdict::converged, "by the residual");
        if (rounding) return log.end_rounding(x, estimate);
        if (log.exhausted()) return log.end_limit(x);
    }
}

}  // namespace neumann
