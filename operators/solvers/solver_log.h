// The part that all solvers share: counts applications, records the history, and checks the solution at the end.
#pragma once

#include "core/base/stopwatch.h"
#include "operators/algebra/change_rate.h"
#include "operators/algebra/term_series.h"
#include "operators/solvers/inverse_bound.h"
#include "operators/solvers/solver.h"
#include "operators/solvers/spectrum/radius_evidence.h"

namespace neumann {

class SolverLog {
public:
    explicit SolverLog(const Problem& problem);

    const Problem& problem() const { return problem_; }
    const ChannelOperator& K() const { return *problem_.K; }

    // ‖x‖∞; 0 if x is empty, not a number if a value is not a number.
    double largest(const Vector& x) const { return K().agreement().size(x); }
    bool all_finite(const Vector& x) const { return K().agreement().all_finite(x); }

    void apply(const Vector& x, Vector& y);  // y = K x, counted
    double applications() const { return result_.applications; }
    void count(double applications) { result_.applications += applications; }
    void setup_ends() { result_.setup = result_.applications; }
    // The applications that compute the solution, without those of diverges() and bound_inverse(), which only judge it.
    double own_applications() const {
        return result_.applications - evidence_.applications() - (inverse_ ? inverse_->applications : 0.0);
    }
    // Whether all allowed applications are used up.
    bool exhausted() const { return own_applications() >= static_cast<double>(problem_.most); }

    // ‖(I − K)⁻¹‖∞, the factor between residuals and errors. It is a bound (inverse_bound.h), found at the first call.
    // If there is no bound, it is 1 / (1 − radius), and without a radius the larger of ‖x‖∞ / ‖Le‖∞ and 1 / (1 − rate),
    // if they are given; these are lower bounds.
    double amplification(const Vector* x = nullptr, double rate = 0.0);
    // The error of x, relative to ‖x‖∞, from its residual r = Le + K x − x; at least the rounding error of x.
    double from_residual(const Vector& r, const Vector& x, double rate = 0.0);
    // ‖x − L‖∞ after the last change, whose size is `change`: the last term of a series, or what a sweep of relaxation
    // changed. The residual is K times the change, plus at most `more` times the change. Bounded by the amplification,
    // or else estimated from the rate.
    double tail(double change, const ChangeRate& rate, double more = 0.0);
    // ‖x − L‖∞ of a series, which may be enclosed as well (operators/algebra/enclosure.h). `before_last` is the term
    // before series.before(), and `sum` is series.sum().
    double tail(const TermSeries& series, const Vector& before_last, const Vector& sum, const ChangeRate& rate);
    // Says in words how tail() was found.
    std::string found_tail(const ChangeRate& rate);
    // The tolerance of a residual, relative to Le, with which a Krylov method begins.
    double first_goal();
    // The error, relative to x, of rounding each term or change by ε.
    double rounding(double rate = 0.0) { return std::numeric_limits<double>::epsilon() * amplification(nullptr, rate); }
    // Whether this residual or change consists of rounding errors, or is kept from falling by them alone.
    bool is_rounding(double change, const Vector& x, bool falling = true) const;

    // Records a step; returns true if the estimate is below the tolerance.
    bool record(double estimate, double error);
    bool reached(const Vector& x, double estimate) { return record(estimate, true_error(x)); }
    double true_error(const Vector& x) const;  // not a number if L is not known

    // Whether the spectral radius of K is 1 or more. If it is not given, it is computed; the applications for that are counted.
    bool diverges();
    // Whether the spectral radius is below 1. Both functions return false if it cannot be found.
    bool converges();

    // Ends with x. A result with verdict `converged` or `rounding` is refused if the given spectral radius is 1 or
    // more, if x is 10¹² times Le, or if Le ≥ 0 but x is negative somewhere and the radius is not below 1. For K ≥ 0, a
    // solution x ≥ 0 proves convergence: x = S_n + K^{n+1} x ≥ S_n for all n.
    SolverResult end(Vector x, Verdict verdict, std::string why);
    // Refuses because the method needs entries of K, and this K can only be applied.
    SolverResult end_without_entries();
    // Ends because all applications are used up. If the radius is known to be 1 or more, the verdict is diverging.
    SolverResult end_limit(Vector x);
    // Ends because diverges() is true; `seen` is what was observed.
    SolverResult end_diverging(Vector x, const std::string& seen);
    // Ends because `what` grew until it was not finite: the verdict is broke_down, unless the series diverges.
    SolverResult end_overflow(Vector x, const char* what);
    // Ends because only rounding is left. `error` is the relative error due to rounding; refused if it is above a thousandth.
    SolverResult end_rounding(Vector x, double error);

private:
    // Whether the amplification is a bound.
    bool is_bounded();

    const Problem& problem_;
    RadiusEvidence evidence_;
    std::optional<InverseBound> inverse_;
    SolverResult result_;
    Stopwatch watch_;
};

}  // namespace neumann
