// What all solvers share: counting, recording, and the gates at the end.
#pragma once

#include "core/base/stopwatch.h"
#include "operators/series/change_rate.h"
#include "operators/solvers/solver.h"

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
    bool exhausted() const { return result_.applications >= static_cast<double>(problem_.most); }

    // Error of x estimated from its residual r = Le + K x − x: ‖r‖∞ / (1 − radius) / ‖x‖∞; the residual alone where the radius is
    // not known to be below 1.
    double from_residual(const Vector& r, const Vector& x) const;

    // Records a step; true when the estimate is below the tolerance.
    bool record(double estimate, double error);
    bool reached(const Vector& x, double estimate) { return record(estimate, true_error(x)); }
    double true_error(const Vector& x) const;  // not a number where L is not known

    // Ends with x. An answer that converged is refused where the spectral radius given is 1 or more, where x is 10¹² times Le, and
    // where Le ≥ 0 but x is negative somewhere. The last is a proof, for K ≥ 0: were x ≥ 0 a solution, then x = S_n + K^{n+1} x ≥
    // S_n for all n and the series would converge.
    SolverResult end(Vector x, Verdict verdict, std::string why);
    SolverResult end_limit(Vector x);

private:
    const Problem& problem_;
    SolverResult result_;
    Stopwatch watch_;
};

double largest(const Vector& x);  // ‖x‖∞, 0 without values, not a number where one is not

}  // namespace neumann
