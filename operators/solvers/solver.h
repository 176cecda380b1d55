// The common interface of the solvers of (I − K) L = Le for one colour channel: problem, options, result and verdict.
#pragma once

#include "operators/algebra/channel_operator.h"
#include "operators/algebra/verdict.h"

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

// One entry of a solver's history.
struct SolverStep {
    double applications = 0.0;  // of K, so far
    double estimate = 0.0;      // of the error, relative to ‖x‖∞ unless the solver's header has another definition
    double error = 0.0;         // ‖x − L‖∞ / ‖L‖∞ if L is known, otherwise not a number
    double seconds = 0.0;       // since the solver began
};

struct Problem {
    const ChannelOperator* K = nullptr;
    Vector Le = {};
    double tolerance = 1e-6;    // of the estimated error, relative to ‖x‖∞
    Eigen::Index most = 10000;  // largest number of applications of K
    // The spectral radius of K, or a bound or estimate of it; turns residuals into errors if ‖(I − K)⁻¹‖∞ has no bound
    // (inverse_bound.h).
    std::optional<double> radius = {};
    std::optional<double> lowest = {};    // lowest eigenvalue of a K with a real spectrum; −radius without it
    const Vector* reflectance = nullptr;  // ρ of each unknown if K = diag(ρ) F with F reciprocal, measure_u F_uv = measure_v F_vu
    const Vector* exact = nullptr;        // L, to record the true error
    std::function<void(const SolverStep&)> observer = {};
};

struct SolverResult {
    Vector x;  // the last iterate, whatever the verdict
    Verdict verdict = Verdict::limit;
    std::string why;
    double applications = 0.0;  // of K, setup included; a relaxation of one of n unknowns counts as 1/n
    double setup = 0.0;         // applications before the first iterate, and those that bound errors
    std::vector<SolverStep> history;
};

using Solver = std::function<SolverResult(const Problem&)>;

}  // namespace neumann
