// Solvers side by side where several processes share K: ours that need sums and products alone, and PETSc's.
#pragma once

#include "operators/solvers/side_by_side.h"
#include "operators/watch.h"

#include <string>
#include <vector>

namespace neumann {

// As solve_side_by_side() and add_petsc_rows(), for all processes together. LU would need K on one of them: the reference is
// PETSc's GMRES, solved until rounding ends it. `told`: what is to be told.
SideBySide solve_shared(const Problem& problem, const std::vector<std::string>& petsc, bool histories, const Watch& watch,
                        std::vector<std::string>& told);

}  // namespace neumann
