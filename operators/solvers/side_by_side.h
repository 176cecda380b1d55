// Runs all solvers on one problem, with the solution of LU as the reference.
#pragma once

#include "operators/solvers/solvers.h"
#include "operators/watch.h"

namespace neumann {

struct SolverRow {
    std::string name, title;  // as in NamedSolver
    SolverResult result = {};
    double seconds = 0.0;
    double error = std::numeric_limits<double>::quiet_NaN();  // ‖x − L‖∞ / ‖L‖∞; not a number if L is not known, and for LU, which
                                                              // is the reference

    // The last estimate of the error; not a number if there is none.
    double estimate() const;
};

struct SideBySide {
    std::string reference = "LU";  // the solver against whose solution the errors are
    std::vector<SolverRow> rows;   // in the order of solvers()
    Vector exact;                  // the reference's L; empty if it gave none
    std::string no_reference;      // why the reference gave no L; empty if it did
    bool interrupted = false;      // the watch stopped the solvers before all rows were there
};

// `histories` records true errors; each solver runs a second time for them, because some are slow when they record
// them. A solver that `watch` stops gets no row. `exact` and `observer` of the problem are not used.
SideBySide solve_side_by_side(Problem problem, bool histories = false, const Watch& watch = {});

}  // namespace neumann
