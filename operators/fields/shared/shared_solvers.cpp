#include "operators/fields/shared/shared_solvers.h"

#include "core/base/stopwatch.h"
#include "operators/solvers/petsc/petsc_solver.h"
#include "operators/solvers/stoppable.h"

namespace neumann {

namespace {

void find_reference(Problem problem, SideBySide& all) {
    // The tolerance is what rounding leaves of a sum that falls as slowly as the spectral radius.
    problem.tolerance = 1e-13;
    problem.observer = nullptr;
    std::string method;
    SolverResult found = solve_petsc(problem, *start_petsc("-ksp_type gmres"), method);
    all.reference = "GMRES";
    if (found.verdict == Verdict::converged || found.verdict == Verdict::rounding)
        all.exact = std::move(found.x);
    else
        all.no_reference = found.why;
}

}  // namespace

SideBySide solve_shared(const Problem& problem, const std::vector<std::string>& petsc, bool histories, const Watch& watch,
                        std::vector<std::string>& messages) {
    SideBySide all;
    const StoppableChannel K(*problem.K, watch);
    const Agreement& agreement = K.agreement();
    Problem stoppable = problem;
    stoppable.K = &K;
    try {
        find_reference(stoppable, all);
        if (histories && all.no_reference.empty()) stoppable.exact = &all.exact;
        for (const char* name : {"neumann", "ratio-tail", "chebyshev"}) {
            const NamedSolver* const solver = find_solver(name);
            const Stopwatch clock;
            SolverRow row{solver->name, solver->title, solver->solve(stoppable)};
            row.seconds = clock.seconds();
            if (all.no_reference.empty()) row.error = agreement.size(row.result.x - all.exact) / agreement.size(all.exact);
            all.rows.push_back(std::move(row));
        }
    } catch (const Stopped&) {
        all.interrupted = true;
    }
    messages = add_petsc_rows(problem, petsc, histories, watch, all);
    return all;
}

}  // namespace neumann
