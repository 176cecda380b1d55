// Solvers side by side for a K that several processes share: neumann's own solvers that need only sums and products, and PETSc's.
#pragma once

#include "operators/solvers/side_by_side.h"
#include "operators/watch.h"

#include <string>
#include <vector>

namespace neumann {

// The results of solve_side_by_side() and add_petsc_rows(), for all processes together. LU would need all of K on one process, so
// the reference is PETSc's GMRES, solved until rounding ends it. `messages` becomes the messages of add_petsc_rows().
SideBySide solve_shared(const Problem& problem, const std::vector<std::string>& petsc, bool histories, const Watch& watch,
                        std::vector<std::string>& messages);

}  // namespace neumann
