// All solvers on one problem, with LU's answer to judge them by.
#pragma once

#include "operators/solvers/solvers.h"

namespace neumann {

struct SolverRow {
    const NamedSolver* solver = nullptr;
    SolverResult result;
    double seconds = 0.0;
    double error = 0.0;  // ‖x − L‖∞ / ‖L‖∞; not a number where L is not known, and for LU, which is the reference

    // The last estimate of the error; not a number where there is none.
    double estimate() const;
};

struct SideBySide {
    std::vector<SolverRow> rows;  // as solvers()
    std::string no_reference;     // why LU gave no L, or nothing
    bool interrupted = false;     // the rows end early
};

struct SideBySideOptions {
    bool histories = false;             // with true errors: each solver runs once more, for some take long over these
    std::function<bool()> interrupted;  // asked before every use of K; the solver that is at work then has no row
};

// `exact` and `observer` of the problem are not used.
SideBySide solve_side_by_side(Problem problem, const SideBySideOptions& options = {});

}  // namespace neumann
