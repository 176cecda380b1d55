#include "operators/solvers/eigenpair_tail.h"

#include "operators/algebra/term_series.h"
#include "operators/solvers/solver_log.h"
#include "operators/solvers/spectrum/spectrum.h"

#include <fmt/format.h>

namespace neumann {

SolverResult solve_eigenpair_tail(const Problem& problem) {
    SolverLog log(problem);
    if (!log.K().has_adjoint()) return log.end(problem.Le, Verdict::refused, "needs K*, which this K does not have");
    const Eigenpairs right = leading_eigenpairs(log.K(), 1), left = leading_eigenpairs(log.K(), 1, true);
    log.count(right.applications + left.applications);
    log.setup_ends();
    if (log.exhausted())
        return log.end(problem.Le, Verdict::limit, "finding the leading eigenpair took all applications that were allowed");
    if (!right.converged || !left.converged) return log.end(problem.Le, Verdict::refused, "the leading eigenpair was not found");
    const std::complex<double> value = right.pairs[0].value;
    if (judge(std::abs(value), 0.0) != Convergence::converges)
        return log.end(problem.Le, Verdict::refused,
                       fmt::format("the spectral radius is {:.6g}: the series diverges", std::abs(value)));
    if (std::abs(value.imag()) > 1e-9 * std::abs(value) || std::abs(value - left.pairs[0].value) > 1e-6 * std::abs(value))
        return log.end(problem.Le, Verdict::refused, "the leading eigenvalue is not real and single");
    const double lambda = value.real();
    const Vector v = right.pairs[0].vector.real(), w = left.pairs[0].vector.real().cwiseProduct(log.K().measure());
    const double scale = w.dot(v);

    TermSeries series(log.K(), problem.Le);
    ChangeRate rate;
    for (;;) {
        // The part of t_n outside the leading mode.
        const double amount = lambda == 0.0 ? 0.0 : w.dot(series.term()) / scale;
        const double other = log.largest(series.term() - amount * v);
        const Vector x = series.sum() + lambda / (1.0 - lambda) * amount * v;
        rate.add(other);
        const double rounding = log.rounding(std::max(rate.rate(), std::abs(lambda))), tail = log.tail(other, rate);
        if (log.reached(x, log.largest(series.term()) == 0.0 ? 0.0 : std::max(tail / log.largest(x), rounding)))
            return log.end(x, Verdict::converged, fmt::format("the other modes fall at the rate {:.6g}", rate.rate()));
        if (!std::isfinite(scale) || !log.all_finite(x))
            return log.end(x, Verdict::broke_down, "the leading eigenvector is defective");
        if (log.is_rounding(tail, x)) return log.end_rounding(x, rounding);
        // These parts fall in the end; what remains of them is the error of the leading eigenpair.
        if (rate.not_falling() && other <= 1e-8 * log.largest(series.term()))
            return log.end(x, Verdict::rounding, "the other modes are down to the accuracy of the leading one");
        if (log.exhausted()) return log.end_limit(x);
        series.advance();
        log.count(1.0);
    }
}

}  // namespace neumann
