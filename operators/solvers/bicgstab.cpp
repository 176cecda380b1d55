#include "operators/solvers/eigen_system.h"
#include "operators/solvers/krylov.h"
#include "operators/solvers/solver_log.h"

#include <fmt/format.h>

namespace neumann {

SolverResult solve_bicgstab(const Problem& problem) {
    SolverLog log(problem);
    const Eigen::Index n = problem.Le.size();
    Vector x = Vector::Zero(n), y = x, last = x, r(n);
    if (problem.Le.isZero(0.0)) return log.end(x, Verdict::converged, "nothing emits");

    // Eigen changes y in place, so the iterate can be read whenever K is applied.
    const EigenSystem* seen = nullptr;
    const auto look = [&] {
        if (y == last) return;
        log.record(log.largest(y - last) / log.largest(y), problem.exact ? log.true_error(seen->unscaled(y)) : log.true_error(y));
        last = y;
    };
    const EigenSystem system(*problem.K, [&] {
        look();
        log.count(1.0);
    });
    seen = &system;
    Eigen::BiCGSTAB<EigenSystem, Eigen::IdentityPreconditioner> bicgstab;
    bicgstab.compute(system);
    const Vector scaled = system.scaled(problem.Le);
    // `goal` is the tolerance of the residual, relative to that of x = 0.
    const double least = std::numeric_limits<double>::epsilon();
    double goal = log.first_goal();
    for (;;) {
        bicgstab.setTolerance(goal);
        bicgstab.setMaxIterations(
            std::max<Eigen::Index>(1, (problem.most - static_cast<Eigen::Index>(log.own_applications())) / 2));
        y = bicgstab.solveWithGuess(scaled, Vector(y));
        look();
        x = system.unscaled(y);
        log.apply(x, r);
        r += problem.Le - x;
        if (!log.all_finite(x) || bicgstab.info() == Eigen::NumericalIssue)
            return log.end(x, Verdict::broke_down, "a division by zero in BiCGSTAB");
        if (log.reached(x, log.from_residual(r, x))) return log.end(x, Verdict::converged, "by the residual");
        if ((goal <= least || log.exhausted()) && log.is_rounding(log.largest(r), x, false))
            return log.end_rounding(x, log.from_residual(r, x));
        if (log.exhausted()) return log.end_limit(x);
        goal = std::max(0.1 * goal, least);
    }
}

}  // namespace neumann
