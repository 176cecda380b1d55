// The Neumann series as a solver, and methods that extrapolate its partial sums to n → ∞ after each term.
//
// t_n = K^n Le and S_n = Σ_{k≤n} t_k. One application per term.
#pragma once

#include "operators/solvers/solver.h"

namespace neumann {

// x = S_n, with compensated summation. The estimate is that of SolverLog::tail().
SolverResult solve_neumann(const Problem&);

// x = S_n + t_n λ/(1−λ) with one ratio for all unknowns, λ = ⟨t_n, t_n⟩ / ⟨t_n, t_{n−1}⟩. If |λ| ≥ 1, for example if
// terms alternate, there is no extrapolation and x = S_n; the result is refused if the method ends in this state. This
// accelerator tolerates noise in the terms, because λ is an average.
SolverResult solve_ratio_tail(const Problem&);

// Aitken's Δ² for each unknown: x = S_n + t_n²/(t_{n−1} − t_n). Breaks down where t_{n−1} = t_n ≠ 0, or t_{n−1} = 0 ≠ t_n.
// A. C. Aitken, On Bernoulli's numerical solution of algebraic equations, Proc. Roy. Soc. Edinburgh 46 (1926).
SolverResult solve_aitken(const Problem&);

// Wynn's ε algorithm per unknown: ε_{k+1}^{(j)} = ε_{k−1}^{(j+1)} + 1/(ε_k^{(j+1)} − ε_k^{(j)}), ε_0^{(j)} = S_j, up to ε_24.
// P. Wynn, On a device for computing the e_m(S_n) transformation, MTAC 10 (1956).
SolverResult solve_wynn_epsilon(const Problem&);

// Wynn's ε algorithm for whole vectors, with Samelson's inverse v⁻¹ = v/⟨v, v⟩.
// P. Wynn, Acceleration techniques for iterated vector and matrix problems, Math. Comp. 16 (1962).
SolverResult solve_vector_epsilon(const Problem&);

}  // namespace neumann
