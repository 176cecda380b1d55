// The two-sided enclosure: widths on the cube with mixed albedos (n = 16, ceiling emits), and that L is inside.
#include "operators/known/cube.h"
#include "operators/known/small_problems.h"
#include "operators/series/series_run.h"
#include "operators/solvers/lu.h"

#include <gtest/gtest.h>

using namespace neumann;
using namespace neumann::known;

// t_{n−1} against t_n; widths, the norm bound of S_n and its true tail relative to ‖L‖∞.
TEST(Enclosures, CubeWithMixedAlbedos) {
    struct Row {
        int n;
        double c1, c2, width, bound, tail;
    };
    const Row rows[] = {
        {5, 0.5138180074090534, 0.8032587428707869, 8.38228739007892e-2, 0.5263211301607131, 0.053111687048543514},
        {8, 0.6467113110831977, 0.6809939422546191, 2.408567908375121e-3, 0.15044127772679844, 0.015777789376206303},
        {12, 0.6611265176542338, 0.6643522929078157, 4.397083129864574e-5, 0.029458148131107566, 0.0030449503372995523},
        {16, 0.6621676895838545, 0.6625043154258586, 8.821492623268e-7, 0.0056769834858819805, 0.0005859710348624664},
        {24, 0.662255079198025, 0.6622598142276755, 4.590114439222745e-10, 0.0002100999651593624, 2.1682606323683657e-05}};
    const Cube cube = patched_cube(16);
    const DenseChannel K = cube.channel(cube.on_faces({.2, .5, .8, .9, .95, .7}));
    Problem problem;
    problem.K = &K;
    problem.Le = cube.ceiling();
    const Vector exact = solve_lu(problem).x;
    for (const Row& row : rows) {
        const SeriesRun run = run_series(K, problem.Le, {.tolerance = 0.0, .most_bounces = row.n, .norm = 0.95});
        const Enclosure& found = run.enclosure;
        ASSERT_TRUE(found.exists) << found.why;
        EXPECT_NEAR(found.c1, row.c1, 1e-9);
        EXPECT_NEAR(found.c2, row.c2, 1e-9);
        EXPECT_NEAR((found.high - found.low).maxCoeff() / exact.maxCoeff(), row.width, 1e-4 * row.width) << row.n;
        EXPECT_NEAR(run.rows[row.n].a_posteriori / exact.maxCoeff(), row.bound, 1e-9);
        EXPECT_NEAR((exact - run.sum).maxCoeff() / exact.maxCoeff(), row.tail, 1e-9);
        // 1e-13 for rounding, which the enclosure leaves out.
        EXPECT_TRUE((found.low.array() <= exact.array() + 1e-13).all()) << row.n;
        EXPECT_TRUE((found.high.array() >= exact.array() - 1e-13).all()) << row.n;
    }
    // Before the light has been everywhere evenly there is none, and it is said why.
    const Enclosure none = run_series(K, problem.Le, {.tolerance = 0.0, .most_bounces = 1}).enclosure;
    EXPECT_FALSE(none.exists);
    EXPECT_EQ(none.why, "the term before is 0 at unknown 0, and this one is not");
}

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
