// Krylov methods for (I − K) L = Le: they need no bounds on the eigenvalues to find a good polynomial of K.
//
// M. R. Hestenes, E. Stiefel, J. Res. NBS 49 (1952); Y. Saad, M. H. Schultz, SIAM J. Sci. Stat. Comp. 7 (1986); H. A. van der
// Vorst, SIAM J. Sci. Stat. Comp. 13 (1992). All start from x = 0, whose residual Le costs nothing.
#pragma once

#include "operators/solvers/solver.h"

namespace neumann {

// Conjugate gradients for K = diag(ρ) F with F reciprocal. I − K is then self-adjoint in Σ_u (measure_u/ρ_u) f_u g_u, and positive
// definite if the spectral radius is below 1: the iterates are those for I − √ρ F √ρ. Unknowns with ρ = 0 have the value Le and are
// moved to the right-hand side, which costs one application if any of them emits.
//
// Needs Problem::reflectance. Refused if ρ < 0, and if K is not of this form, as a traced K is only approximately: the largest
// |⟨K p, q⟩ − ⟨p, K q⟩| / (‖K p‖ ‖q‖) over successive directions, which is known at no extra cost, must be within the tolerance.
SolverResult solve_conjugate_gradients(const Problem&);

// GMRES (Eigen) in the norm weighted with the measure, restarted after `restart` steps. Estimates in the history are ‖r‖₂/‖Le‖₂,
// except the last one, SolverLog::from_residual, for which K is applied once more. Iterates exist only at the end. If the exact
// solution is given, the true error after k steps comes from solving again with k steps, up to the first restart; this is not
// counted.
SolverResult solve_gmres(const Problem&, int restart = 50);

// BiCGSTAB (Eigen) in the same norm: two applications per step and little memory. Estimates in the history are ‖Δx‖∞/‖x‖∞, except
// the last one, which is as for GMRES.
SolverResult solve_bicgstab(const Problem&);

}  // namespace neumann
