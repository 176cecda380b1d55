#include "operators/solvers/side_by_side.h"

#include "core/base/stopwatch.h"
#include "operators/solvers/progress.h"

#include <string_view>

namespace neumann {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

SolverRow run(const NamedSolver& solver, const Problem& problem) {
    const Stopwatch watch;
    SolverRow row{&solver, solver.solve(problem), 0.0, unknown};
    row.seconds = watch.seconds();
    return row;
}

}  // namespace

double SolverRow::estimate() const { return result.history.empty() ? unknown : result.history.back().estimate; }

SideBySide solve_side_by_side(Problem problem, const SideBySideOptions& options) {
    SideBySide all;
    problem.exact = nullptr;
    problem.observer = nullptr;
    const SolverRow reference = run(*find_solver("lu"), problem);
    const bool known = reference.result.verdict == Verdict::converged;
    if (!known) all.no_reference = reference.result.why;
    for (const NamedSolver& solver : solvers()) {
        if (options.interrupted && options.interrupted()) {
            all.interrupted = true;
            break;
        }
        if (&solver == reference.solver) {
            all.rows.push_back(reference);
            continue;
        }
        SolverRow row = run(solver, problem);
        const Vector& L = reference.result.x;
        if (known && largest(L) > 0.0) row.error = largest(row.result.x - L) / largest(L);
        if (known && options.histories) {
            Problem judged = problem;
            judged.exact = &L;
            row.result.history = solver.solve(judged).history;
        }
        all.rows.push_back(std::move(row));
    }
    return all;
}

}  // namespace neumann
