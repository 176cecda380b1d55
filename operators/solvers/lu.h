// The reference: (I − K) L = Le by LU with partial pivoting, where the matrix fits.
#pragma once

#include "operators/solvers/solver.h"

namespace neumann {

// K is formed column by column, which counts as one application. Refused where the matrix is larger than `most_bytes`, and where
// the answer is negative: elimination solves a divergent problem without noticing.
SolverResult solve_lu(const Problem&, double most_bytes = 2e9);

}  // namespace neumann
