// Krylov methods for (I − K) L = Le: of all polynomials of K of a degree they find a good one by themselves.
//
// M. R. Hestenes, E. Stiefel, J. Res. NBS 49 (1952); Y. Saad, M. H. Schultz, SIAM J. Sci. Stat. Comp. 7 (1986); H. A. van der
// Vorst, SIAM J. Sci. Stat. Comp. 13 (1992). All start from x = 0, whose residual Le costs nothing.
#pragma once

#include "operators/solvers/solver.h"

namespace neumann {

// Conjugate gradients for K = diag(ρ) F with F reciprocal. I − K is then self-adjoint in Σ_u (measure_u/ρ_u) f_u g_u, and definite
// where the spectral radius is below 1: the same iterates as for I − √ρ F √ρ. Unknowns with ρ = 0 hold Le and are taken to the
// other side, which costs one application if any of them emits.
//
// Needs Problem::reflectance. Refused where ρ < 0, and where K is not of this kind, as a traced K is not quite: the largest
// |⟨K p, q⟩ − ⟨p, K q⟩| / (‖K p‖ ‖q‖) over successive directions, which costs nothing to look at, has to be within the tolerance.
SolverResult solve_conjugate_gradients(const Problem&);

// GMRES (Eigen) in the norm weighted with the measure, restarted after `restart` steps. Estimates in the history are ‖r‖₂/‖Le‖₂,
// the last one Progress::from_residual, for which K is applied once more. Iterates exist only at the end; where the exact solution
// is given the true errors after k steps come from solving anew with k steps, which is not counted, for k up to the first restart.
SolverResult solve_gmres(const Problem&, int restart = 50);

// BiCGSTAB (Eigen) in the same norm: two applications a step and little memory. Estimates in the history are ‖Δx‖∞/‖x‖∞, the last
// one as for GMRES.
SolverResult solve_bicgstab(const Problem&);

}  // namespace neumann
