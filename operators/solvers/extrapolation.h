// The common loop of all methods that extrapolate the partial sums of the series.
#pragma once

#include "operators/algebra/term_series.h"
#include "operators/solvers/solver.h"

#include <functional>
#include <optional>
#include <string>

namespace neumann {

// Why a method has no extrapolated limit after this term.
struct Trouble {
    Verdict verdict;
    std::string why;
};

// Called after each term from t_0 on; writes the extrapolated limit into x, or returns the reason why there is none.
using Extrapolate = std::function<std::optional<Trouble>(const TermSeries&, Vector& x)>;

// Ends when two successive limits differ by less than the tolerance and the residual of the last one, which takes one more
// application of K, is also small enough; if it is not, checks again after twice as many terms. After Trouble, S_n is used in place
// of the limit; if S_n converges first, it is the result. Divergence is detected as for the series; SolverLog::end may refuse the
// result.
SolverResult solve_extrapolated(const Problem&, const Extrapolate&);

}  // namespace neumann
