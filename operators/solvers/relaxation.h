// Relaxation: L_u is solved for from its own equation, one unknown after another.
//
//     x_u ← (Le_u + Σ_{v≠u} K_uv x_v) / (1 − K_uu)
//
// One sweep over all unknowns reads or writes every entry of K once, and counts as one application. D. M. Young, Iterative Solution
// of Large Linear Systems, 1971; M. F. Cohen, S. E. Chen, J. R. Wallace, D. P. Greenberg, A progressive refinement approach to fast
// radiosity image generation, SIGGRAPH 1988.
#pragma once

#include "operators/solvers/solver.h"

namespace neumann {

// Unknowns in their order, gathering rows.
SolverResult solve_gauss_seidel(const Problem&);

// The same, each change multiplied by omega, 0 < omega < 2.
SolverResult solve_sor(const Problem&, double omega);

// Southwell's relaxation, in radiosity called shooting: the unknown with the most unshot power measure_u |r_u| first, scattering
// columns. Each relaxation counts 1/n application; the history has a look every n/4 relaxations.
SolverResult solve_southwell(const Problem&);

}  // namespace neumann
