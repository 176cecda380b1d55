// PETSc's methods as solvers of (I − K) L = Le, and SLEPc's eigenpairs and norms of K.
#pragma once

#include "operators/solvers/petsc/petsc.h"
#include "operators/solvers/side_by_side.h"
#include "operators/solvers/spectrum/spectrum.h"

#include <optional>

namespace neumann {

// The options of each solver that `--petsc TEXT` requests. An empty text requests one of each kind: no preconditioner,
// the diagonal, blocks, and multigrid.
std::vector<std::string> petsc_options(const std::string& text);

// K as a PetscMatrix, which refers to K.
PetscMatrix petsc_matrix(const ChannelOperator& K);

// Solves with the method that PETSc's options name; `method` becomes its name, "gmres/jacobi". A step of the history is
// an iteration, and its estimate is ‖r‖₂ / ‖Le‖₂ in the norm that the method uses; the estimate of the last step is
// SolverLog::from_residual. While that is too large, PETSc runs again with a smaller tolerance, unless the options set
// the tolerance.
SolverResult solve_petsc(const Problem& problem, Petsc& petsc, std::string& method);

// Adds a row for each of `options`, "PETSc gmres/jacobi", with its error against the reference of `all` if there is
// one. Returns messages about the options that PETSc has not read. The rows end if `watch` stops a solver. `histories`
// is as in solve_side_by_side().
std::vector<std::string> add_petsc_rows(const Problem& problem, const std::vector<std::string>& options, bool histories,
                                        const Watch& watch, SideBySide& all);

// The result of leading_eigenpairs(), by the SLEPc method that the options name. If several processes share K, each
// gets the values of its unknowns. Adds to `messages` the messages that add_petsc_rows() would return.
Eigenpairs slepc_eigenpairs(const ChannelOperator& K, int count, const std::string& options, const EigenLimits& limits = {},
                            std::vector<std::string>* messages = nullptr);

// The result of operator_norms(), for a K that several processes may share; `one_at` is a number among this process's
// unknowns, or −1 if another process has that unknown.
OperatorNorms slepc_norms(const ChannelOperator& K, const EigenLimits& limits = {});

}  // namespace neumann
