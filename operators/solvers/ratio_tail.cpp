#include "operators/solvers/extrapolation.h"
#include "operators/solvers/series_solvers.h"

#include <fmt/format.h>

namespace neumann {

SolverResult solve_ratio_tail(const Problem& problem) {
    return solve_extrapolated(problem, [&](const TermSeries& series, Vector& x) -> std::optional<Trouble> {
        if (series.bounce() == 0) return Trouble{Verdict::refused, "one term is not enough"};
        const Vector& measure = problem.K->measure();
        const Vector weighted = measure.cwiseProduct(series.term());
        double products[] = {weighted.dot(series.term()), weighted.dot(series.before())};
        problem.K->agreement().sum(products);
        const double lambda = products[0] / products[1];
        // This also catches NaN.
        if (!(std::abs(lambda) < 1.0))
            return Trouble{Verdict::refused,
                           fmt::format("the ratio of terms is {:.4g}: they do not fall by one ratio below 1", lambda)};
        x = series.sum() + lambda / (1.0 - lambda) * series.term();
        return std::nullopt;
    });
}

}  // namespace neumann
