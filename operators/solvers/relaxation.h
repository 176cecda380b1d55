// Relaxation: solves each equation for its own unknown L_u, one unknown after another.
//
//     x_u ← (Le_u + Σ_{v≠u} K_uv x_v) / (1 − K_uu)
//
// One sweep over all unknowns reads or writes every entry of K once, and counts as one application. D. M. Young, Iterative Solution
// of Large Linear Systems, 1971; M. F. Cohen, S. E. Chen, J. R. Wallace, D. P. Greenberg, A progressive refinement approach to fast
// radiosity image generation, SIGGRAPH 1988.
#pragma once

#include "operators/solvers/solver.h"

namespace neumann {

// Visits the unknowns in order and gathers along rows of K.
SolverResult solve_gauss_seidel(const Problem&);

// Gauss-Seidel with each change multiplied by omega, 0 < omega < 2.
SolverResult solve_sor(const Problem&, double omega);

// Southwell's relaxation, called shooting in radiosity: always relaxes the unknown with the most unshot power measure_u |r_u|, and
// scatters along its column of K. A relaxation counts as 1/n application; the history has an entry every n/4 relaxations.
SolverResult solve_southwell(const Problem&);

}  // namespace neumann
