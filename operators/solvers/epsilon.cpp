#include "operators/solvers/extrapolation.h"
#include "operators/solvers/series_solvers.h"

#include <algorithm>
#include <array>
#include <deque>

namespace neumann {

namespace {

constexpr std::size_t depth = 24;

// The last entry of the highest even column that can be computed from the sums s_0 … s_n.
double wynn(std::array<double, depth + 1> column, std::size_t n) {
    std::array<double, depth + 1> before{};
    double best = column[n];
    for (std::size_t k = 1; k <= n; ++k) {
        std::array<double, depth + 1> next;
        for (std::size_t j = 0; j + k <= n; ++j) {
            // Equal entries make this infinite, and the entry after next finite again; two equal pairs in a row give NaN.
            next[j] = before[j + 1] + 1.0 / (column[j + 1] - column[j]);
            if (std::isnan(next[j])) return best;
        }
        before = column;
        column = next;
        if (k % 2 == 0 && std::isfinite(column[n - k])) best = column[n - k];
    }
    return best;
}

}  // namespace

SolverResult solve_wynn_epsilon(const Problem& problem) {
    std::deque<Vector> sums;
    return solve_extrapolated(problem, [&](const TermSeries& series, Vector& x) -> std::optional<Trouble> {
        sums.push_back(series.sum());
        if (sums.size() > depth + 1) sums.pop_front();
        if (series.bounce() < 2) return Trouble{Verdict::broke_down, "three sums are needed"};
        x.resize(series.term().size());
        for (Eigen::Index u = 0; u < x.size(); ++u) {
            std::array<double, depth + 1> s{};
            for (std::size_t j = 0; j < sums.size(); ++j) s[j] = sums[j][u];
            x[u] = wynn(s, sums.size() - 1);
        }
        return std::nullopt;
    });
}

SolverResult solve_vector_epsilon(const Problem& problem) {
    std::vector<Vector> diagonal, next;  // ε_k^{(n−k)} for k = 0, 1, …
    return solve_extrapolated(problem, [&](const TermSeries& series, Vector& x) -> std::optional<Trouble> {
        const Vector& measure = problem.K->measure();
        next.assign(1, series.sum());
        for (std::size_t k = 1; k <= std::min(depth, diagonal.size()); ++k) {
            Vector difference = next[k - 1] - diagonal[k - 1];
            const double square = measure.dot(difference.cwiseAbs2());
            if (!(square > 0.0) || !std::isfinite(1.0 / square)) break;
            difference /= square;
            if (k > 1) difference += diagonal[k - 2];
            next.push_back(std::move(difference));
        }
        std::swap(diagonal, next);
        x = diagonal[(diagonal.size() - 1) / 2 * 2];
        if (series.bounce() < 2) return Trouble{Verdict::broke_down, "three sums are needed"};
        return std::nullopt;
    });
}

}  // namespace neumann
