#include "operators/solvers/solvers.h"

#include "operators/solvers/anderson.h"
#include "operators/solvers/chebyshev.h"
#include "operators/solvers/eigenpair_tail.h"
#include "operators/solvers/krylov.h"
#include "operators/solvers/lu.h"
#include "operators/solvers/relaxation.h"
#include "operators/solvers/series_solvers.h"

namespace neumann {

const std::vector<NamedSolver>& solvers() {
    static const std::vector<NamedSolver> all = {
        {"neumann", "Neumann series", solve_neumann},
        {"ratio-tail", "series + one ratio for the tail", solve_ratio_tail},
        {"aitken", "Aitken, each unknown", solve_aitken},
        {"wynn", "Wynn's epsilon, each unknown", solve_wynn_epsilon},
        {"vector-epsilon", "vector epsilon", solve_vector_epsilon},
        {"eigenpair-tail", "series + leading eigenpair", solve_eigenpair_tail},
        {"gauss-seidel", "Gauss-Seidel", solve_gauss_seidel},
        {"sor", "SOR, 1.2", [](const Problem& problem) { return solve_sor(problem, 1.2); }},
        {"southwell", "Southwell, shooting", solve_southwell},
        {"chebyshev", "Chebyshev", [](const Problem& problem) { return solve_chebyshev(problem); }},
        {"anderson-1", "Anderson, m = 1", [](const Problem& problem) { return solve_anderson(problem, 1); }},
        {"anderson-3", "Anderson, m = 3", [](const Problem& problem) { return solve_anderson(problem, 3); }},
        {"anderson-8", "Anderson, m = 8", [](const Problem& problem) { return solve_anderson(problem, 8); }},
        {"cg", "conjugate gradients", solve_conjugate_gradients},
        {"gmres", "GMRES(50)", [](const Problem& problem) { return solve_gmres(problem); }},
        {"bicgstab", "BiCGSTAB", solve_bicgstab},
        {"lu", "LU", [](const Problem& problem) { return solve_lu(problem); }},
    };
    return all;
}

const NamedSolver* find_solver(std::string_view name) {
    for (const NamedSolver& solver : solvers()) {
        if (solver.name == name) return &solver;
    }
    return nullptr;
}

}  // namespace neumann
