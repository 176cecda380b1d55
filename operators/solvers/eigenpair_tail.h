// The series with the tail of the slowest mode in closed form: x = S_n + v ⟨w, t_n⟩/⟨w, v⟩ λ/(1−λ), with K v = λ v, K* w = λ w the
// leading eigenpair.
//
// The error then falls like |λ₂|^n. A spectral projection, Y. Saad, Numerical Methods for Large Eigenvalue Problems, 2nd ed., 2011.
#pragma once

#include "operators/solvers/solver.h"

namespace neumann {

// The eigenpairs of K and K* are computed first; their applications count as setup. Refused if they are not found, if λ is complex,
// and if |λ| ≥ 1.
SolverResult solve_eigenpair_tail(const Problem&);

}  // namespace neumann
