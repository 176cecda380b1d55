// What all solvers share: counting, recording, and the gates at the end.
#pragma once

#include "core/base/stopwatch.h"
#include "operators/series/change_rate.h"
#include "operators/solvers/solver.h"
#include "operators/spectrum/radius_evidence.h"

namespace neumann {

class Progress {
public:
    explicit Progress(const Problem& problem);

    const Problem& problem() const { return problem_; }
    const ChannelOperator& K() const { return *problem_.K; }

    void apply(const Vector& x, Vector& y);  // y = K x, counted
    double applications() const { return result_.applications; }
    void count(double applications) { result_.applications += applications; }
    void setup_ends() { result_.setup = result_.applications; }
    // Without those that diverges() took.
    bool exhausted() const { return result_.applications - evidence_.applications() >= static_cast<double>(problem_.most); }

    // Error of x estimated from its residual r = Le + K x − x: ‖r‖∞ / (1 − radius) / ‖x‖∞. Where the radius is not given, as much
    // as Le became x, by ‖x‖∞ / ‖Le‖∞, if not by 1 / (1 − rate): a lower bound of what (I − K)⁻¹ makes of r. At least what rounding
    // leaves of x.
    double from_residual(const Vector& r, const Vector& x, double rate = 0.0) const;
    // ε / (1 − q): what is left, relative to x, of rounding each term or change by ε where they fall like q^n. q is the radius, if
    // it is known to be below 1, or else `rate`.
    double rounding(double rate = 0.0) const;
    // Rounding is all that is left of this residual or change, or all that keeps it from getting smaller.
    static bool is_rounding(double change, const Vector& x, bool falling = true);

    // Records a step; true when the estimate is below the tolerance.
    bool record(double estimate, double error);
    bool reached(const Vector& x, double estimate) { return record(estimate, true_error(x)); }
    double true_error(const Vector& x) const;  // not a number where L is not known

    // Whether the spectral radius of K is 1 or more: as given, or else found, which is counted.
    bool diverges();
    // The same, and less than 1; false both where it cannot be found.
    bool converges();

    // Ends with x. An answer that converged, or that rounding keeps from it, is refused where the spectral radius given is 1 or
    // more, where x is 10¹² times Le, and where Le ≥ 0 but x is negative somewhere, unless the radius is below 1. The last is a
    // proof, for K ≥ 0: were x ≥ 0 a solution, then x = S_n + K^{n+1} x ≥ S_n for all n and the series would converge.
    SolverResult end(Vector x, Verdict verdict, std::string why);
    // Refused, by a method that takes unknowns one by one: this K can only be applied.
    SolverResult end_without_entries();
    // All applications are used up; or the radius, where it is known, says why they do not help.
    SolverResult end_limit(Vector x);
    // diverges(), and what was seen of it.
    SolverResult end_diverging(Vector x, const std::string& seen);
    // `what` grew until it was not finite: the method breaks down where the series does not diverge.
    SolverResult end_overflow(Vector x, const char* what);
    // `error`: what rounding leaves. Refused where that is more than a thousandth.
    SolverResult end_rounding(Vector x, double error);

private:
    const Problem& problem_;
    RadiusEvidence evidence_;
    SolverResult result_;
    Stopwatch watch_;
};

double largest(const Vector& x);  // ‖x‖∞, 0 without values, not a number where one is not

}  // namespace neumann
