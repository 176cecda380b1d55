#include "operators/solvers/krylov.h"
#include "operators/solvers/solver_log.h"

#include <fmt/format.h>

#include <algorithm>

namespace neumann {

SolverResult solve_conjugate_gradients(const Problem& problem) {
    SolverLog log(problem);
    const Eigen::Index n = problem.Le.size();
    if (!problem.reflectance || problem.reflectance->size() != n)
        return log.end(problem.Le, Verdict::refused,
                       "needs the reflectance ρ of each unknown, with K = diag(ρ) F and F reciprocal");
    const auto& rho = problem.reflectance->array();
    if (!(rho >= 0.0).all()) return log.end(problem.Le, Verdict::refused, "reflectances have to be at least 0");
    // Black unknowns have weight 0 and the value Le.
    const Vector weight = (rho > 0.0).select(log.K().measure().array() / rho, 0.0).matrix();
    const Vector fixed = (rho > 0.0).select(0.0, problem.Le.array()).matrix();
    const auto dot = [&](const Vector& f, const Vector& g) { return f.cwiseProduct(weight).dot(g); };

    Vector r = problem.Le - fixed, Kp(n);
    if (!fixed.isZero(0.0)) {
        log.apply(fixed, Kp);
        r += Kp;
        log.setup_ends();
    }
    Vector x = fixed, p = r, last_p, last_Kp;
    double rr = dot(r, r), defect = 0.0;
    for (;;) {
        if (rr == 0.0) {
            const double estimate = log.from_residual(r, x);
            if (!log.reached(x, estimate)) return log.end_rounding(x, estimate);
            return log.end(x, Verdict::converged, "the residual is 0");
        }
        log.apply(p, Kp);
        if (last_p.size() != 0) {
            const double size = std::sqrt(dot(Kp, Kp) * dot(last_p, last_p));
            if (size > 0.0) defect = std::max(defect, std::abs(dot(Kp, last_p) - dot(p, last_Kp)) / size);
        }
        if (defect > std::max(problem.tolerance, 1e-10))
            return log.end(x, Verdict::refused,
                           fmt::format("K is not diag(ρ) F with F reciprocal: its defect is {:.2g}, the tolerance {:.2g}", defect,
                                       problem.tolerance));
        const double curvature = dot(p, p) - dot(p, Kp);
        if (!(curvature > 0.0))
            return log.end(x, Verdict::diverging, "I − K is not positive definite: the spectral radius of K is 1 or more");
        const double alpha = rr / curvature;
        x += alpha * p;
        r -= alpha * (p - Kp);
        if (log.reached(x, log.from_residual(r, x))) return log.end(x, Verdict::converged, "by the residual");
        if (log.is_rounding(log.largest(r), x)) return log.end_rounding(x, log.from_residual(r, x));
        if (log.exhausted()) return log.end_limit(x);
        const double next = dot(r, r);
        last_p = p;
        last_Kp = Kp;
        p = r + next / rr * p;
        rr = next;
    }
}

}  // namespace neumann
