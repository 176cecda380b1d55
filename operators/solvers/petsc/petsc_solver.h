// PETSc's methods as solvers of (I − K) L = Le, and SLEPc's eigenpairs of K, beside those of operators/solvers and spectrum.
#pragma once

#include "operators/solvers/petsc/petsc.h"
#include "operators/solvers/side_by_side.h"
#include "operators/solvers/spectrum/spectrum.h"

#include <optional>

namespace neumann {

// What `--petsc TEXT` asks for: the options of each solver to be run. An empty text: something of each kind, no preconditioner, the
// diagonal, blocks, and multigrid.
std::vector<std::string> petsc_options(const std::string& text);

// K; it refers to it.
PetscMatrix petsc_matrix(const ChannelOperator& K);

// Solves with the method that PETSc's options name; `method` becomes its name, "gmres/jacobi". A step of the history is an
// iteration, its estimate ‖r‖₂ / ‖Le‖₂ in the norm that the method looks at, but for the last one, which is
// SolverLog::from_residual. PETSc is asked again with a smaller tolerance while that is too large, unless the options set the
// tolerance.
SolverResult solve_petsc(const Problem& problem, Petsc& petsc, std::string& method);

// Adds a row for each of `options`, "PETSc gmres/jacobi", with its error against the reference of `all` if there is one, and
// returns what is to be told: the options that PETSc has not asked for. If `watch` stops it, the rows end. `histories` as in
// solve_side_by_side().
std::vector<std::string> add_petsc_rows(const Problem& problem, const std::vector<std::string>& options, bool histories,
                                        const Watch& watch, SideBySide& all);

// As leading_eigenpairs(), by SLEPc's method that the options name; for a K that several processes share, each gets the values of
// its unknowns. `told`: as what add_petsc_rows() returns.
Eigenpairs slepc_eigenpairs(const ChannelOperator& K, int count, const std::string& options, const EigenLimits& limits = {},
                            std::vector<std::string>* told = nullptr);

// As operator_norms(), for such a K as well; `one_at` is a number among this process's unknowns, or −1 if another has it.
OperatorNorms slepc_norms(const ChannelOperator& K, const EigenLimits& limits = {});

}  // namespace neumann
