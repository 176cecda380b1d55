// The reference: (I − K) L = Le by LU with partial pivoting, if the matrix fits in memory.
#pragma once

#include "operators/solvers/solver.h"

namespace neumann {

// Forms K column by column, which counts as one application. Refused if the matrix is larger than `most_bytes`, and if
// the solution is negative, because elimination also solves problems whose series diverges.
SolverResult solve_lu(const Problem&, double most_bytes = 2e9);

}  // namespace neumann
