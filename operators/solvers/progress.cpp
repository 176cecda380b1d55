#include "operators/solvers/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace neumann {

double largest(const Vector& x) { return x.size() == 0 ? 0.0 : x.lpNorm<Eigen::Infinity>(); }

Progress::Progress(const Problem& problem) : problem_(problem) {
    if (!problem.K || problem.K->size() != problem.Le.size())
        throw std::invalid_argument("Le needs one value for each unknown of K");
    if (problem.exact && problem.exact->size() != problem.Le.size())
        throw std::invalid_argument("the exact solution needs one value for each unknown of K");
}

void Progress::apply(const Vector& x, Vector& y) {
    problem_.K->apply(x, y);
    count(1.0);
}

double Progress::from_residual(const Vector& r, const Vector& x) const {
    const double size = largest(x), residual = largest(r);
    if (residual == 0.0) return 0.0;
    const double amplification = problem_.radius && *problem_.radius < 1.0 ? 1.0 / (1.0 - *problem_.radius) : 1.0;
    return residual * amplification / size;
}

double Progress::true_error(const Vector& x) const {
    return problem_.exact ? largest(x - *problem_.exact) / largest(*problem_.exact) : std::numeric_limits<double>::quiet_NaN();
}

bool Progress::record(double estimate, double error) {
    result_.history.push_back({result_.applications, estimate, error, watch_.seconds()});
    if (problem_.observer) problem_.observer(result_.history.back());
    return estimate <= problem_.tolerance;
}

SolverResult Progress::end(Vector x, Verdict verdict, std::string why) {
    if (!x.allFinite() && verdict != Verdict::diverging) {
        verdict = Verdict::broke_down;
        why = "values that are not finite";
    }
    if (verdict == Verdict::converged && x.size() > 0) {
        const double lowest = x.minCoeff();
        if (problem_.radius && *problem_.radius >= 1.0) {
            verdict = Verdict::refused;
            why = fmt::format(
                "the spectral radius is {:.6g}: the series diverges, and this solves (I − K) L = Le without being its sum",
                *problem_.radius);
        } else if (largest(x) > 1e12 * largest(problem_.Le)) {
            verdict = Verdict::refused;
            why = fmt::format("it is {:.2g} times Le: I − K is singular to rounding", largest(x) / largest(problem_.Le));
        } else if (problem_.Le.minCoeff() >= 0.0 && lowest < -std::max(1e-9, 10.0 * problem_.tolerance) * largest(x)) {
            verdict = Verdict::refused;
            why = fmt::format(
                "negative radiance, {:.6g}: the series diverges, and this solves (I − K) L = Le without being its sum", lowest);
        }
    }
    result_.x = std::move(x);
    result_.verdict = verdict;
    result_.why = std::move(why);
    return std::move(result_);
}

SolverResult Progress::end_limit(Vector x) {
    return end(std::move(x), Verdict::limit, fmt::format("{} applications were used up", problem_.most));
}

}  // namespace neumann
