// All solvers by name.
#pragma once

#include "operators/solvers/solver.h"

#include <string_view>
#include <vector>

namespace neumann {

struct NamedSolver {
    const char* name;   // short, for a command line: lower case and hyphens
    const char* title;  // for a table
    Solver solve;
};

// All solvers in the order of tables: the series, its extrapolations, relaxation, polynomial and Krylov methods, and LU
// as the reference.
const std::vector<NamedSolver>& solvers();

// Returns nullptr if there is none with this name.
const NamedSolver* find_solver(std::string_view name);

}  // namespace neumann
