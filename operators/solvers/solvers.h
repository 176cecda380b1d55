// All solvers by name, for whoever runs them side by side.
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

// In the order of a table: the series, what extrapolates it, relaxation, polynomials, Krylov, and LU as the reference.
const std::vector<NamedSolver>& solvers();

// nullptr where there is none of this name.
const NamedSolver* find_solver(std::string_view name);

}  // namespace neumann
