#include "operators/solvers/eigen_system.h"
#include "operators/solvers/krylov.h"
#include "operators/solvers/progress.h"

#include <fmt/format.h>

namespace neumann {

SolverResult solve_bicgstab(const Problem& problem) {
    Progress progress(problem);
    const Eigen::Index n = problem.Le.size();
    Vector x = Vector::Zero(n), y = x, last = x, r(n);
    if (problem.Le.isZero(0.0)) return progress.end(x, Verdict::converged, "nothing emits");

    // Eigen changes y in place, so the iterate can be read whenever K is applied.
    const EigenSystem* seen = nullptr;
    const auto look = [&] {
        if (y == last) return;
        progress.record(largest(y - last) / largest(y),
                        problem.exact ? progress.true_error(seen->unscaled(y)) : progress.true_error(y));
        last = y;
    };
    const EigenSystem system(*problem.K, [&] {
        look();
        progress.count(1.0);
    });
    seen = &system;
    Eigen::BiCGSTAB<EigenSystem, Eigen::IdentityPreconditioner> bicgstab;
    bicgstab.compute(system);
    const Vector scaled = system.scaled(problem.Le);
    // Tolerance of the residual, relative to that of x = 0.
    const double least = std::numeric_limits<double>::epsilon();
    double goal = std::max(problem.tolerance * (problem.radius && *problem.radius < 1.0 ? 1.0 - *problem.radius : 1.0), least);
    for (;;) {
        bicgstab.setTolerance(goal);
        bicgstab.setMaxIterations(
            std::max<Eigen::Index>(1, (problem.most - static_cast<Eigen::Index>(progress.applications())) / 2));
        y = bicgstab.solveWithGuess(scaled, Vector(y));
        look();
        x = system.unscaled(y);
        progress.apply(x, r);
        r += problem.Le - x;
        if (!x.allFinite() || bicgstab.info() == Eigen::NumericalIssue)
            return progress.end(x, Verdict::broke_down, "a division by zero in BiCGSTAB");
        if (progress.reached(x, progress.from_residual(r, x))) return progress.end(x, Verdict::converged, "by the residual");
        if ((goal <= least || progress.exhausted()) && Progress::is_rounding(largest(r), x, false))
            return progress.end_rounding(x, progress.from_residual(r, x));
        if (progress.exhausted()) return progress.end_limit(x);
        goal = std::max(0.1 * goal, least);
    }
}

}  // namespace neumann
