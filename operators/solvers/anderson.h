// Anderson's mixing of x ← Le + K x with the last m changes.
//
// D. G. Anderson, J. ACM 12 (1965); H. F. Walker, P. Ni, SIAM J. Numer. Anal. 49 (2011), its form as least squares:
//     x_{k+1} = g_k − Σ_j γ_j Δg_j,   γ minimising ‖f_k − Σ_j γ_j Δf_j‖₂,   g = Le + K x,   f = g − x.
// With unbounded m it is equivalent to GMRES, with m = 1 to the secant method. One application per step, 2m vectors.
#pragma once

#include "operators/solvers/solver.h"

namespace neumann {

// Keeps the last m ≥ 1 changes. The norm is weighted with the measure.
SolverResult solve_anderson(const Problem&, int m);

}  // namespace neumann
