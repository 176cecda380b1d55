#include "operators/solvers/relaxation.h"

#include "operators/solvers/solver_log.h"

#include <fmt/format.h>

#include <algorithm>

namespace neumann {

SolverResult solve_gauss_seidel(const Problem& problem) { return solve_sor(problem, 1.0); }

SolverResult solve_sor(const Problem& problem, double omega) {
    SolverLog log(problem);
    const ChannelOperator& K = log.K();
    if (!K.has_entries()) return log.end_without_entries();
    Vector x = problem.Le;
    ChangeRate rate;
    for (;;) {
        double change = 0.0;
        for (Eigen::Index u = 0; u < x.size(); ++u) {
            // 1 − K_uu ≤ 0 means that patch u alone, seen by itself, has no finite radiance.
            const double rest = 1.0 - K.diagonal(u);
            if (!(rest > 0.0)) return log.end(x, Verdict::diverging, fmt::format("K_uu ≥ 1 at unknown {}", u));
            const double step = omega * (problem.Le[u] + K.row(u, x) - x[u]) / rest;
            x[u] += step;
            change = std::max(change, std::abs(step));
        }
        log.count(1.0);
        if (!log.all_finite(x)) return log.end_overflow(x, "the iterates");
        rate.add(change);
        const double rounding = log.rounding(rate.rate()), size = log.largest(x);
        // The part of its own change that is left in the residual of an unknown.
        const double kept = std::abs(1.0 / omega - 1.0);
        if (log.reached(x, size == 0.0 ? 0.0 : std::max(change == 0.0 ? 0.0 : log.tail(change, rate, kept) / size, rounding)))
            return log.end(x, Verdict::converged, fmt::format("the changes fall at the rate {:.6g}", rate.rate()));
        if (log.is_rounding(change, x, !rate.not_falling())) return log.end_rounding(x, rounding);
        if (rate.not_falling() && log.diverges())
            return log.end_diverging(x, "the changes did not get smaller over the last 32 sweeps");
        if (log.exhausted()) return log.end_limit(x);
    }
}

SolverResult solve_southwell(const Problem& problem) {
    SolverLog log(problem);
    const ChannelOperator& K = log.K();
    if (!K.has_entries()) return log.end_without_entries();
    const Eigen::Index n = problem.Le.size();
    const double cost = 1.0 / static_cast<double>(std::max<Eigen::Index>(n, 1));
    Vector x = Vector::Zero(n), r = problem.Le;
    const double power = K.measure().dot(problem.Le.cwiseAbs());
    for (Eigen::Index i = 1;; ++i) {
        Eigen::Index u = 0;
        if (n > 0) r.cwiseProduct(K.measure()).cwiseAbs().maxCoeff(&u);
        if (n == 0 || r[u] == 0.0) {
            log.reached(x, 0.0);
            return log.end(x, Verdict::converged, "nothing is left to shoot");
        }
        const double rest = 1.0 - K.diagonal(u);
        if (!(rest > 0.0)) return log.end(x, Verdict::diverging, fmt::format("K_uu ≥ 1 at unknown {}", u));
        const double step = r[u] / rest;
        x[u] += step;
        r[u] -= step;
        K.add_column(u, step, r);
        log.count(cost);
        if (i % std::max<Eigen::Index>(1, n / 4) != 0) continue;
        if (log.reached(x, log.from_residual(r, x))) return log.end(x, Verdict::converged, "by the residual");
        if (log.is_rounding(log.largest(r), x)) return log.end_rounding(x, log.from_residual(r, x));
        if (!log.all_finite(x)) return log.end_overflow(x, "the iterates");
        if (!(K.measure().dot(r.cwiseAbs()) < 1e6 * power) && log.diverges())
            return log.end_diverging(x, "the unshot power grew to a million times the emitted power");
        if (log.exhausted()) return log.end_limit(x);
    }
}

}  // namespace neumann
