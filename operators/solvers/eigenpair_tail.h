// The series with the slowest mode summed at once: x = S_n + v ⟨w, t_n⟩/⟨w, v⟩ λ/(1−λ), with K v = λ v, K* w = λ w the leading
// pair.
//
// The error then falls like |λ₂|^n. A spectral projection, Y. Saad, Numerical Methods for Large Eigenvalue Problems, 2nd ed., 2011.
#pragma once

#include "operators/solvers/solver.h"

namespace neumann {

// The pairs of K and K* are found first, and counted as setup. Refused where they are not found, where λ is complex, and where |λ|
// ≥ 1.
SolverResult solve_eigenpair_tail(const Problem&);

}  // namespace neumann
