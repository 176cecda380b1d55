#include "operators/solvers/side_by_side.h"

#include "core/base/stopwatch.h"
#include "operators/solvers/solver_log.h"
#include "operators/solvers/stoppable.h"

namespace neumann {

namespace {

SolverRow run(const NamedSolver& solver, const Problem& problem) {
    const Stopwatch watch;
    SolverRow row{solver.name, solver.title, solver.solve(problem)};
    row.seconds = watch.seconds();
    return row;
}

void run_all(const Problem& problem, bool histories, SideBySide& all) {
    const SolverRow reference = run(*find_solver("lu"), problem);
    const Agreement& agreement = problem.K->agreement();
    const bool known = reference.result.verdict == Verdict::converged;
    if (known)
        all.exact = reference.result.x;
    else
        all.no_reference = reference.result.why;
    for (const NamedSolver& solver : solvers()) {
        if (solver.name == reference.name) {
            all.rows.push_back(reference);
            continue;
        }
        SolverRow row = run(solver, problem);
        const Vector& L = reference.result.x;
        if (known && agreement.size(L) > 0.0) row.error = agreement.size(row.result.x - L) / agreement.size(L);
        if (known && histories) {
            Problem judged = problem;
            judged.exact = &L;
            row.result.history = solver.solve(judged).history;
        }
        all.rows.push_back(std::move(row));
    }
}

}  // namespace

double SolverRow::estimate() const {
    return result.history.empty() ? std::numeric_limits<double>::quiet_NaN() : result.history.back().estimate;
}

SideBySide solve_side_by_side(Problem problem, bool histories, const Watch& watch) {
    SideBySide all;
    problem.exact = nullptr;
    problem.observer = nullptr;
    const StoppableChannel K(*problem.K, watch);
    problem.K = &K;
    try {
        run_all(problem, histories, all);
    } catch (const Stopped&) {
        all.interrupted = true;
    }
    return all;
}

}  // namespace neumann
