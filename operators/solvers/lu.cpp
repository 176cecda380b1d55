#include "operators/solvers/lu.h"

#include "operators/solvers/solver_log.h"

#include <fmt/format.h>
#include <Eigen/LU>

namespace neumann {

SolverResult solve_lu(const Problem& problem, double most_bytes) {
    SolverLog log(problem);
    if (!log.K().has_entries()) return log.end_without_entries();
    const Eigen::Index n = problem.Le.size();
    const double bytes = 2.0 * sizeof(double) * static_cast<double>(n) * static_cast<double>(n);
    if (bytes > most_bytes)
        return log.end(problem.Le, Verdict::refused,
                       fmt::format("{} unknowns need {:.3g} GB, {:.3g} are allowed", n, bytes / 1e9, most_bytes / 1e9));
    Eigen::MatrixXd A(n, n);
    Vector column(n);
    for (Eigen::Index u = 0; u < n; ++u) {
        column.setZero();
        log.K().add_column(u, -1.0, column);
        column[u] += 1.0;
        A.col(u) = column;
    }
    log.count(1.0);
    const Eigen::PartialPivLU<Eigen::Ref<Eigen::MatrixXd>> lu(A);
    Vector x = lu.solve(problem.Le);
    const double rcond = lu.rcond();
    if (!(rcond > 1e-14))
        return log.end(x, Verdict::broke_down, fmt::format("I − K is singular to rounding: reciprocal condition {:.2g}", rcond));
    const double estimate = std::numeric_limits<double>::epsilon() / rcond;
    if (log.reached(x, estimate)) return log.end(x, Verdict::converged, "eliminated");
    return log.end_rounding(x, estimate);
}

}  // namespace neumann
