// What stops the series, and what must not; more of it in operators/experiments/known/series_verdicts.cpp.
#include "operators/experiments/known/cube.h"
#include "operators/experiments/known/small_problems.h"
#include "operators/solvers/remaining.h"
#include "operators/solvers/series_run.h"

#include <gtest/gtest.h>

namespace neumann::series_runs_test {

using namespace known;

// Rounding does not pile up: 27618 terms of ρ = 0.999, in double and compensated.
TEST(SeriesRuns, LongSumsKeepTheirDigits) {
    for (const double rho : {0.9, 0.99, 0.999}) {
        CompensatedSum<Vector> sum(Vector::Zero(1));
        CompensatedSum<Eigen::VectorXf> sum_f(Eigen::VectorXf::Zero(1));
        const float rho_f = static_cast<float>(rho);
        double t = 1.0;
        float t_f = 1.0f;
        while (t > 1e-16) {
            sum.add(Vector::Constant(1, t));
            sum_f.add(Eigen::VectorXf::Constant(1, t_f));
            t *= rho;
            t_f *= rho_f;
        }
        EXPECT_NEAR(sum.value()[0] * (1.0 - rho), 1.0, 1e-13);
        // Float terms, against the sum for the rounded ρ: 4.8e-8, 3.8e-8, 3.1e-7 remain, naive addition leaves 2e-5 at 0.999.
        EXPECT_NEAR(sum_f.value()[0] * (1.0 - static_cast<double>(rho_f)), 1.0, 4e-7);
    }
}

TEST(SeriesRuns, AlbedoOneDoesNotConverge) {
    const DenseChannel K = furnace(1.0);
    const SeriesRun run = run_series(K, Vector::Ones(3), {.norm = 1.0});
    EXPECT_EQ(run.verdict, Verdict::diverging);
    EXPECT_EQ(run.why,
              "not converging: the terms did not get smaller over the last 32 bounces, rate 1, and the spectral radius is 1");
    ASSERT_EQ(run.warnings.size(), 1u);
    EXPECT_EQ(run.warnings[0], "a = 1 is not below 1 and bounds nothing; the series may converge all the same");
    EXPECT_NEAR(run.sum[0], static_cast<double>(run.rows.size()), 1e-12);  // S_n = n + 1
}

TEST(SeriesRuns, LimitIsNotConvergence) {
    const SeriesRun run = run_series(plates(), vector({1, 0}), {.most_bounces = 5});
    EXPECT_EQ(run.verdict, Verdict::limit);
    EXPECT_EQ(run.why, "5 bounces were used up");
    EXPECT_EQ(run.rows.size(), 6u);
    EXPECT_EQ(run_series(plates(), vector({0, 0})).verdict, Verdict::converged);
}

// Closed and uniform: Σ_{k>n} ρ^k / Σ ρ^k = ρ^{n+1}, whatever is emitted.
TEST(SeriesRuns, BouncesUntilLittleRemains) {
    const Cube cube = symmetric_cube(4);
    const DenseChannel K = cube.channel(0.9);
    const std::vector<SeriesRow> rows = run_series(K, cube.ceiling(), {.tolerance = 1e-9, .norm = 0.9}).rows;
    EXPECT_EQ(bounces_until(rows, 0.1), 21);    // 0.9^22 = 0.0985
    EXPECT_EQ(bounces_until(rows, 0.5), 6);     // 0.9^7 = 0.478
    EXPECT_EQ(bounces_until(rows, 1e-9), 196);  // beyond the rows: 0.9^197 = 9.7e-10
    EXPECT_EQ(bounces_until({}, 0.1), std::nullopt);
    EXPECT_EQ(bounces_until(rows, 0.01), 43);   // 0.9^44 = 0.0097
    EXPECT_EQ(bounces_until(rows, 0.001), 65);  // 0.9^66 = 0.00096
}

}  // namespace neumann::series_runs_test
