#include "operators/solvers/solver_log.h"

#include "operators/solvers/enclosed_terms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace neumann {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

}  // namespace

SolverLog::SolverLog(const Problem& problem) : problem_(problem), evidence_(problem.K, problem.radius) {
    if (!problem.K || problem.K->size() != problem.Le.size())
        throw std::invalid_argument("Le needs one value for each unknown of K");
    if (problem.exact && problem.exact->size() != problem.Le.size())
        throw std::invalid_argument("the exact solution needs one value for each unknown of K");
}

void SolverLog::apply(const Vector& x, Vector& y) {
    problem_.K->apply(x, y);
    count(1.0);
}

bool SolverLog::is_bounded() {
    if (!inverse_) {
        inverse_ = bound_inverse(K());
        count(inverse_->applications);
        result_.setup += inverse_->applications;
    }
    return std::isfinite(inverse_->norm);
}

double SolverLog::amplification(const Vector* x, double rate) {
    double least = 1.0;
    if (problem_.radius) {
        if (*problem_.radius < 1.0) least = 1.0 / (1.0 - *problem_.radius);
    } else {
        if (x) least = largest(*x) / largest(problem_.Le);
        if (rate < 1.0) least = std::max(least, 1.0 / (1.0 - rate));
    }
    return is_bounded() ? std::max(inverse_->norm, least) : least;
}

double SolverLog::from_residual(const Vector& r, const Vector& x, double rate) {
    const double size = largest(x), residual = largest(r);
    if (residual == 0.0 && size == 0.0) return 0.0;
    return std::max(residual * amplification(&x, rate) / size, rounding(rate));
}

double SolverLog::tail(double change, const ChangeRate& rate, double more) {
    // (I − K)⁻¹ K 1 = (I − K)⁻¹ 1 − 1.
    return is_bounded() ? change * (amplification() - 1.0 + amplification() * more) : rate.estimate();
}

double SolverLog::tail(const TermSeries& series, const Vector& before_last, const Vector& sum, const ChangeRate& rate) {
    const double bound = tail(largest(series.term()), rate);
    const Enclosure enclosure = enclose_last(series, before_last, sum, K().agreement());
    if (!enclosure.exists) return bound;
    const double enclosed = largest(enclosure.high - sum);
    return is_bounded() ? std::min(bound, enclosed) : enclosed;
}

std::string SolverLog::found_tail(const ChangeRate& rate) {
    return fmt::format("{} the rate {:.6g}", is_bounded() ? "bounded, at" : "estimated from", rate.rate());
}

double SolverLog::first_goal() { return std::max(problem_.tolerance / amplification(), epsilon); }

bool SolverLog::is_rounding(double change, const Vector& x, bool falling) const {
    const double size = largest(x);
    return size > 0.0 && change <= (falling ? epsilon : 1e-12) * size;
}

double SolverLog::true_error(const Vector& x) const {
    return problem_.exact ? largest(x - *problem_.exact) / largest(*problem_.exact) : std::numeric_limits<double>::quiet_NaN();
}

bool SolverLog::record(double estimate, double error) {
    result_.history.push_back({result_.applications, estimate, error, watch_.seconds()});
    if (problem_.observer) problem_.observer(result_.history.back());
    return estimate <= problem_.tolerance;
}

bool SolverLog::diverges() {
    const double before = evidence_.applications();
    const bool shown = evidence_.shows_divergence();
    count(evidence_.applications() - before);
    return shown;
}

bool SolverLog::converges() {
    diverges();
    return evidence_.known_to_converge();
}

SolverResult SolverLog::end(Vector x, Verdict verdict, std::string why) {
    if (!all_finite(x) && verdict != Verdict::diverging) {
        if (verdict != Verdict::broke_down) why = "values that are not finite";
        verdict = Verdict::broke_down;
    }
    if ((verdict == Verdict::converged || verdict == Verdict::rounding) && K().unknowns() > 0) {
        const double lowest = K().agreement().lowest(x);
        if (problem_.radius && *problem_.radius >= 1.0) {
            verdict = Verdict::refused;
            why = fmt::format(
                "the spectral radius is {:.6g}: the series diverges, and this solves (I − K) L = Le without being its sum",
                *problem_.radius);
        } else if (largest(x) > 1e12 * largest(problem_.Le)) {
            verdict = Verdict::refused;
            why = fmt::format("it is {:.2g} times Le: I − K is singular to rounding", largest(x) / largest(problem_.Le));
        } else if (K().agreement().lowest(problem_.Le) >= 0.0 && lowest < -std::max(1e-9, 10.0 * problem_.tolerance) * largest(x) &&
                   !converges()) {
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

SolverResult SolverLog::end_without_entries() {
    return end(problem_.Le, Verdict::refused, "needs the entries of K, its rows and columns, and this K can only be applied");
}

SolverResult SolverLog::end_limit(Vector x) {
    if (evidence_.known_to_diverge())
        return end_diverging(std::move(x), fmt::format("{} applications were used up", problem_.most));
    return end(std::move(x), Verdict::limit, fmt::format("{} applications were used up", problem_.most));
}

SolverResult SolverLog::end_diverging(Vector x, const std::string& seen) {
    return end(std::move(x), Verdict::diverging, fmt::format("{}, and the spectral radius is {:.6g}", seen, evidence_.radius()));
}

SolverResult SolverLog::end_overflow(Vector x, const char* what) {
    const std::string seen = fmt::format("{} grew until they were not finite", what);
    return diverges() ? end_diverging(std::move(x), seen) : end(std::move(x), Verdict::broke_down, seen);
}

SolverResult SolverLog::end_rounding(Vector x, double error) {
    const std::string left = fmt::format("rounding leaves an error of about {:.2g}", error);
    if (!(error < 1e-3)) return end(std::move(x), Verdict::refused, left + ": I − K is singular to rounding");
    return end(std::move(x), Verdict::rounding, left);
}

}  // namespace neumann
