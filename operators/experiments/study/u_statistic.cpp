#include "operators/experiments/study/u_statistic.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace neumann {

double u_statistic(const SymmetricMatrix& g) {
    const auto n = static_cast<double>(g.size());
    double sum = 0.0;
    for (std::size_t j = 0; j < g.size(); ++j)
        for (std::size_t k = 0; k < j; ++k) sum += g(j, k);
    return 2.0 * sum / (n * (n - 1.0));
}

double u_statistic_error(const SymmetricMatrix& g) {
    if (g.size() < 4) return std::numeric_limits<double>::infinity();
    const auto n = static_cast<double>(g.size());
    // Subtracting U changes no covariance and loses fewer digits.
    const double u = u_statistic(g);
    double all = 0.0, squares = 0.0, rows = 0.0;  // Σ_{j≠k} G, Σ_{j≠k} G², Σ_j (Σ_{k≠j} G)²
    for (std::size_t j = 0; j < g.size(); ++j) {
        double row = 0.0;
        for (std::size_t k = 0; k < g.size(); ++k) {
            if (k == j) continue;
            row += g(j, k) - u;
            squares += (g(j, k) - u) * (g(j, k) - u);
        }
        all += row;
        rows += row * row;
    }
    const double none_common = (all * all - 4.0 * rows + 2.0 * squares) / (n * (n - 1.0) * (n - 2.0) * (n - 3.0)),
                 one_common = (rows - squares) / (n * (n - 1.0) * (n - 2.0)), both_common = squares / (n * (n - 1.0));
    const double zeta1 = std::max(one_common - none_common, 0.0), zeta2 = std::max(both_common - none_common, 0.0);
    return std::sqrt((4.0 * (n - 2.0) * zeta1 + 2.0 * zeta2) / (n * (n - 1.0)));
}

}  // namespace neumann
