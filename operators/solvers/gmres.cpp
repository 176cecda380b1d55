#include "operators/solvers/eigen_system.h"
#include "operators/solvers/krylov.h"
#include "operators/solvers/solver_log.h"

#include <fmt/format.h>
#include <unsupported/Eigen/IterativeSolvers>

namespace neumann {

namespace {

using Gmres = Eigen::GMRES<EigenSystem, Eigen::IdentityPreconditioner>;

Vector after_steps(const Problem& problem, int k) {
    const EigenSystem system(*problem.K, [] {});
    Gmres gmres(system);
    gmres.set_restart(k);
    gmres.setMaxIterations(k);
    gmres.setTolerance(0.0);
    return system.unscaled(gmres.solve(system.scaled(problem.Le)));
}

}  // namespace

SolverResult solve_gmres(const Problem& problem, int restart) {
    SolverLog log(problem);
    const Eigen::Index n = problem.Le.size();
    const int steps = static_cast<int>(std::clamp<Eigen::Index>(restart, 1, std::max<Eigen::Index>(1, n)));
    Vector x = Vector::Zero(n), r(n);
    if (problem.Le.isZero(0.0)) return log.end(x, Verdict::converged, "nothing emits");

    Gmres gmres;
    bool begun = false;  // a step has begun; its residual is known when K is applied next
    const auto look = [&] {
        const int k = static_cast<int>(log.own_applications());
        log.record(gmres.error(), problem.exact && k <= steps ? log.true_error(after_steps(problem, k))
                                                              : std::numeric_limits<double>::quiet_NaN());
    };
    const EigenSystem system(*problem.K, [&] {
        if (begun) look();
        begun = true;
        log.count(1.0);
    });
    gmres.compute(system);
    gmres.set_restart(steps);
    // `goal` is the tolerance of the residual, relative to that of x = 0.
    const double least = std::numeric_limits<double>::epsilon();
    double goal = log.first_goal();
    for (;;) {
        gmres.setTolerance(goal);
        gmres.setMaxIterations(std::max<Eigen::Index>(1, problem.most - static_cast<Eigen::Index>(log.own_applications())));
        const Vector guess = system.scaled(x);
        x = system.unscaled(gmres.solveWithGuess(system.scaled(problem.Le), guess));
        look();
        log.apply(x, r);
        r += problem.Le - x;
        if (log.reached(x, log.from_residual(r, x))) return log.end(x, Verdict::converged, "by the residual");
        if ((goal <= least || log.exhausted()) && log.is_rounding(log.largest(r), x, false))
            return log.end_rounding(x, log.from_residual(r, x));
        if (log.exhausted()) return log.end_limit(x);
        goal = std::max(0.1 * goal, least);
        begun = false;
    }
}

}  // namespace neumann
