#include "operators/solvers/extrapolation.h"
#include "operators/solvers/series_solvers.h"

#include <fmt/format.h>

namespace neumann {

SolverResult solve_aitken(const Problem& problem) {
    return solve_extrapolated(problem, [](const TermSeries& series, Vector& x) -> std::optional<Trouble> {
        const Vector &t = series.term(), &before = series.before();
        if (series.bounce() == 0) return Trouble{Verdict::broke_down, "one term is not enough"};
        x = series.sum();
        Eigen::Index broken = 0;
        for (Eigen::Index u = 0; u < x.size(); ++u) {
            const double difference = before[u] - t[u];
            if (t[u] == 0.0) continue;  // nothing to add
            if (difference == 0.0 || before[u] == 0.0)
                ++broken;
            else
                x[u] += t[u] * t[u] / difference;
        }
        if (broken == 0) return std::nullopt;
        return Trouble{
            Verdict::broke_down,
            fmt::format("no ratio of terms at {} of {} unknowns: a term is 0, or equal to the one before", broken, x.size())};
    });
}

}  // namespace neumann
