// Two unknowns, where everything can be written down: near-parallel plates (concentric spheres) and the dome over a disc. Their
// terms and eigenvalues are in operators/experiments/known/two_patches.cpp.
#include "operators/experiments/known/small_problems.h"
#include "operators/solvers/series_run.h"
#include "operators/solvers/solvers.h"

#include <gtest/gtest.h>

namespace neumann::two_patches_test {

using namespace known;

// L by Cramer's rule.
TEST(TwoPatches, AllSolversSolveThem) {
    const double rho_dome[] = {0.7, 0.5}, rho_plates[] = {0.9, 0.9};
    for (const bool is_dome : {true, false}) {
        const DenseChannel K = is_dome ? dome() : plates();
        const Vector rho = Eigen::Map<const Vector>(is_dome ? rho_dome : rho_plates, 2);
        const auto& m = K.matrix();
        const double determinant = (1 - m(0, 0)) * (1 - m(1, 1)) - m(0, 1) * m(1, 0);
        const Vector exact = vector({(1 - m(1, 1)) / determinant, m(1, 0) / determinant});
        Problem problem;
        problem.K = &K;
        problem.Le = vector({1, 0});
        problem.tolerance = 1e-10;
        problem.radius = is_dome ? 0.5616062299 : 0.9;
        problem.lowest = is_dome ? -0.3116062299 : -0.88209;
        problem.reflectance = &rho;
        for (const NamedSolver& solver : solvers()) {
            const SolverResult result = solver.solve(problem);
            EXPECT_EQ(result.verdict, Verdict::converged) << solver.name << ": " << result.why;
            EXPECT_LE((result.x - exact).lpNorm<Eigen::Infinity>(), 1e-9 * exact.lpNorm<Eigen::Infinity>()) << solver.name;
        }
    }
}

// Ratios of neighbours jump between 0.018 and 44; every second term falls evenly, and encloses.
TEST(TwoPatches, AlternatingTermsAreEnclosedInPairs) {
    const DenseChannel K = plates();
    const SeriesRun run = run_series(K, vector({1, 0}), {.tolerance = 1e-6, .norm = 0.9});
    EXPECT_EQ(run.verdict, Verdict::converged) << run.why;
    EXPECT_EQ(run.rows[1].enclosure_width, std::numeric_limits<double>::infinity());
    EXPECT_NEAR(run.rows[3].term.sup / run.rows[2].term.sup, 0.882446409, 1e-9);
    EXPECT_NEAR(run.rows[4].term.sup / run.rows[3].term.sup, 0.9, 1e-12);
    // From n on, with the error of the plain sum ‖t_{n+1} + …‖∞ as known exactly.
    EXPECT_NEAR(run.rows[4].a_posteriori, 0.6305016938609962 * 9.0, 1e-12);
    const Enclosure early = run_series(K, vector({1, 0}), {.tolerance = 0.0, .most_bounces = 12, .norm = 0.9}).enclosure;
    const double determinant = (1 - .01791) - .9 * .88209;
    ASSERT_TRUE(early.exists) << early.why;
    EXPECT_LE(early.low[0], (1 - .01791) / determinant);
    EXPECT_GE(early.high[0], (1 - .01791) / determinant);
    EXPECT_LE(early.low[1], .88209 / determinant);
    EXPECT_GE(early.high[1], .88209 / determinant);
}

}  // namespace neumann::two_patches_test
