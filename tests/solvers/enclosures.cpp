// The two-sided enclosure: what it stops, and what has none. Its figures are in operators/experiments/known/series_verdicts.cpp.
#include "operators/experiments/known/cube.h"
#include "operators/experiments/known/small_problems.h"
#include "operators/solvers/lu.h"
#include "operators/solvers/series_run.h"

#include <gtest/gtest.h>

namespace neumann::enclosures_test {

using namespace known;

TEST(Enclosures, StopTheSeriesEarly) {
    const Cube cube = symmetric_cube(16);
    const DenseChannel K = cube.channel(0.99);
    Problem problem;
    problem.K = &K;
    problem.Le = cube.ceiling();
    const Vector exact = solve_lu(problem).x;
    const SeriesRun run = run_series(K, problem.Le, {.tolerance = 1e-8, .norm = 0.99});
    EXPECT_EQ(run.verdict, Verdict::converged) << run.why;
    EXPECT_LT(run.rows.size(), 60u);  // the plain sum takes about 1800
    EXPECT_LE((run.sum - exact).lpNorm<Eigen::Infinity>(), 1e-8 * exact.maxCoeff());
}

TEST(Enclosures, NegativeTermsHaveNone) {
    const Enclosure found = enclose(vector({1, -1}), vector({0.5, -0.5}), vector({1.5, -1.5}), vector({0.5, -0.5}));
    EXPECT_FALSE(found.exists);
    EXPECT_EQ(found.why, "a term is negative or not a number at unknown 1");
    EXPECT_EQ(enclose(vector({1, 1}), vector({0.5, 1.5}), vector({1, 1}), vector({1, 1})).why,
              "the largest quotient of terms is 1.5, not below 1");
}

}  // namespace neumann::enclosures_test
