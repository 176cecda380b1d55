// What stops the series, and what must not.
#include "operators/known/cube.h"
#include "operators/known/small_problems.h"
#include "operators/solvers/series_run.h"
#include "operators/spectrum/remaining.h"

#include <gtest/gtest.h>

using namespace neumann;
using namespace neumann::known;

// K^n Le = ρ^n; relative remainder after S_n is ρ^{n+1}: terms for 1e-6 and 1e-12.
TEST(SeriesRuns, Furnace) {
    struct Row {
        double rho;
        int micro, pico;
    };
    for (const Row& row : {Row{0.5, 19, 39}, Row{0.9, 131, 262}, Row{0.99, 1374, 2749}, Row{0.999, 13808, 27617}}) {
        const DenseChannel K = furnace(row.rho);
        TermSeries series(K, Vector::Ones(3));
        const double L = 1.0 / (1.0 - row.rho);
        while ((L - series.sum()[0]) / L > 1e-6 * (1 + 1e-9)) series.advance();
        EXPECT_EQ(series.bounce(), row.micro) << row.rho;
        EXPECT_NEAR(series.term()[0], std::pow(row.rho, row.micro), 1e-11 * std::pow(row.rho, row.micro));
        // All unknowns fall alike, and the enclosure closes at once; so do both bounds.
        const SeriesRun run = run_series(K, Vector::Ones(3), {.tolerance = 1e-12, .norm = row.rho});
        ASSERT_EQ(run.rows.size(), 2u);
        EXPECT_NEAR(run.sum[0], L, 1e-11 * L);
        EXPECT_NEAR(run.rows[1].a_posteriori, row.rho * row.rho * L, 1e-12 * L);
        EXPECT_NEAR(run.rows[1].a_priori, row.rho * row.rho * L, 1e-12 * L);
    }
}

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

// t_n = 0.5^n + 1e-6 · 0.99^n, in two rooms: the ratio of the loud room says 2e-6 at n = 20, the tail is 25 times that.
TEST(SeriesRuns, HiddenSlowComponent) {
    const DenseChannel K = separate_rooms(0.5, 0.99);
    const Vector Le = vector({1, 1e-6});
    const SeriesRun run = run_series(K, Le, {.tolerance = 1e-7, .norm = 0.99});
    EXPECT_EQ(run.verdict, Verdict::converged);
    EXPECT_NEAR(run.sum[0], 2.0, 2e-7);
    EXPECT_NEAR(run.sum[1], 1e-4, 2e-7);
    const std::vector<SeriesRow> rows = run_series(K, Le, {.tolerance = 0.0, .most_bounces = 20}).rows;
    EXPECT_NEAR(rows[10].ratio, 0.5002290760634021, 1e-12);
    EXPECT_NEAR(rows[15].ratio, 0.5068765527547062, 1e-12);
    EXPECT_NEAR(rows[20].ratio, 0.6480958734373757, 1e-12);
    const double power = rows[20].term.power, ratio = rows[20].ratio;
    EXPECT_NEAR(8.192646113853209e-05 / (power * ratio / (1 - ratio)), 25.11008731388987, 1e-8);
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

// ‖K‖∞ = 1.6 and 2: a warning both times, and only the second diverges. K^i Le = ρ (mean ρ)^{i−1}.
TEST(SeriesRuns, NormAboveOneIsAWarning) {
    const SeriesRun run = run_series(sphere_halves(1.6, 0.2), Vector::Ones(2), {.tolerance = 1e-12, .norm = 1.6});
    EXPECT_EQ(run.verdict, Verdict::converged) << run.why;
    EXPECT_EQ(run.warnings.size(), 1u);
    EXPECT_NEAR(run.sum[0], 17.0, 1e-10);
    EXPECT_NEAR(run.sum[1], 3.0, 1e-10);
    const SeriesRun above = run_series(sphere_halves(2.0, 0.2), Vector::Ones(2), {.norm = 2.0});
    EXPECT_EQ(above.verdict, Verdict::diverging);
    EXPECT_NEAR(above.rate, 1.1, 1e-12);
}

// Light that goes round three mirrors: terms never vanish over the whole scene, though each unknown is dark two times out of three.
TEST(SeriesRuns, PeriodThree) {
    const SeriesRun run = run_series(carousel(0.9), vector({1, 0, 0}), {.tolerance = 1e-9, .norm = 0.9});
    EXPECT_EQ(run.verdict, Verdict::converged) << run.why;
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(run.sum[k], std::pow(0.9, k) / (1 - 0.729), 1e-8);
    for (const SeriesRow& row : run.rows) EXPECT_NEAR(row.term.sup, std::pow(0.9, row.bounce), 1e-12);
}

// A light behind m mirrors: terms that do not fall are no divergence yet, and a series that ends, ends.
TEST(SeriesRuns, PeriscopeEnds) {
    constexpr int m = 20;
    DenseChannel::Matrix K = DenseChannel::Matrix::Zero(m + 1, m + 1);
    for (int u = 0; u < m; ++u) K(u + 1, u) = 1.0;
    const SeriesRun run = run_series(DenseChannel(K, Vector::Ones(m + 1)), Vector::Unit(m + 1, 0));
    EXPECT_EQ(run.verdict, Verdict::converged);
    EXPECT_EQ(run.why, "term 21 is 0, and so are all that follow");
    EXPECT_EQ(run.sum, Vector::Ones(m + 1));
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
