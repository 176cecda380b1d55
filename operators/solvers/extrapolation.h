// The loop around whatever extrapolates the partial sums of the series.
#pragma once

#include "operators/solvers/solver.h"
#include "operators/solvers/term_series.h"

#include <functional>
#include <optional>
#include <string>

namespace neumann {

// Why a method has no answer after this term.
struct Trouble {
    Verdict verdict;
    std::string why;
};

// Called after each term from t_0 on; writes the extrapolated limit into x, or returns what is in the way.
using Extrapolate = std::function<std::optional<Trouble>(const TermSeries&, Vector& x)>;

// Ends when two limits in a row differ by less than the tolerance and the residual of the last, found with one more application of
// K, agrees; where it does not, looks again after twice as many terms. Where there is trouble S_n stands in for the limit, and is
// what it ends with if it gets there first, as the series alone would. Diverging as there; refused is what Progress::end refuses.
SolverResult solve_extrapolated(const Problem&, const Extrapolate&);

}  // namespace neumann
