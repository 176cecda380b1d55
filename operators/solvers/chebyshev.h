// Chebyshev's semi-iteration: the polynomial of K that is smallest on an interval of eigenvalues.
//
// K must have real eigenvalues in [lowest, highest], highest < 1. G. H. Golub, R. S. Varga, Numer. Math. 3 (1961); Y.
// Saad, Iterative Methods for Sparse Linear Systems, 2nd ed., algorithm 12.1. One application per step. If the interval
// does not contain all eigenvalues, convergence is slower or lost.
#pragma once

#include "operators/solvers/solver.h"

namespace neumann {

// Refused unless lowest ≤ highest < 1.
SolverResult solve_chebyshev(const Problem&, double lowest, double highest);

// Uses the interval [Problem::lowest, Problem::radius]; refused without a radius.
SolverResult solve_chebyshev(const Problem&);

}  // namespace neumann
