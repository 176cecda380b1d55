// How many applications of K each method takes on the cube of 16 × 16 patches a face whose ceiling emits, until ‖x − L‖∞ ≤ ε ‖L‖∞
// for ε = 1e-3, 1e-6, 1e-10, with L by LU. What other programs count is in operators/experiments/known/acceleration.cpp.
#include "operators/experiments/known/cube.h"
#include "operators/solvers/krylov.h"
#include "operators/solvers/lu.h"
#include "operators/solvers/relaxation.h"
#include "operators/solvers/series_solvers.h"
#include "operators/solvers/solvers.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neumann::acceleration_test {

using namespace known;

constexpr double goals[] = {1e-3, 1e-6, 1e-10};
using Counts = std::array<double, 3>;

class Acceleration {
public:
    Acceleration(Cube cube, Vector rho) : cube_(std::move(cube)), rho_(std::move(rho)), K_(cube_.channel(rho_)) {
        problem_.K = &K_;
        problem_.Le = cube_.ceiling();
        problem_.reflectance = &rho_;
        problem_.tolerance = 1e-14;
        exact_ = solve_lu(problem_).x;
        problem_.exact = &exact_;
    }

    // The first applications after which the error is within each goal; 0 where it never was.
    Counts counts(const Solver& solve, int most) {
        problem_.most = most;
        const SolverResult result = solve(problem_);
        Counts found{};
        for (int i = 0; i < 3; ++i)
            for (const SolverStep& step : result.history)
                if (step.error <= goals[i]) {
                    found[i] = step.applications - result.setup;
                    break;
                }
        return found;
    }

    Problem& problem() { return problem_; }

private:
    Cube cube_;
    Vector rho_;
    DenseChannel K_;
    Problem problem_;
    Vector exact_;
};

Acceleration uniform(double rho) {
    const Cube cube = symmetric_cube(16);
    return {cube, Vector::Constant(cube.size(), rho)};
}

// The quotient by the symmetries of the square stands for the whole cube: same iterates, same counts, but for rounding at the
// threshold.
TEST(AccelerationSlow, QuotientTakesAsManyAsTheWholeCube) {
    const Cube cube = patched_cube(16);
    Acceleration whole(cube, Vector::Constant(cube.size(), 0.9)), quotient = uniform(0.9);
    for (const char* method : {"neumann", "ratio-tail", "aitken", "vector-epsilon", "anderson-3", "cg", "gmres"}) {
        const Solver& solve = find_solver(method)->solve;
        const Counts a = whole.counts(solve, 220), b = quotient.counts(solve, 220);
        EXPECT_EQ(a[0], b[0]) << method;
        EXPECT_EQ(a[1], b[1]) << method;
        EXPECT_NEAR(a[2], b[2], 1) << method;
    }
}

// What has no outside figures, by theory: with eigenvalues in [λ_n, λ_1] Gauss–Seidel needs between a third and all of the series'
// applications (1/2 where K is consistently ordered), shooting does the same work in another order, and one more mode summed
// exactly leaves the second eigenvalue, 0.473 at ρ = 0.9: ln(1e10)/ln(1/0.473) = 31.
TEST(Acceleration, RelaxationAndTheLeadingPair) {
    Acceleration cube = uniform(0.9);
    const Counts series = cube.counts(solve_neumann, 1000), sweeps = cube.counts(solve_gauss_seidel, 1000);
    const Counts shots = cube.counts(solve_southwell, 1000), bicgstab = cube.counts(solve_bicgstab, 100);
    const Counts gmres = cube.counts([](const Problem& problem) { return solve_gmres(problem); }, 40);
    const Counts tail = cube.counts(find_solver("eigenpair-tail")->solve, 200);
    for (int i = 0; i < 3; ++i) {
        EXPECT_GT(sweeps[i], series[i] / 3);
        EXPECT_LT(sweeps[i], series[i]);
        EXPECT_GT(shots[i], series[i] / 3);
        EXPECT_LT(shots[i], series[i]);
        EXPECT_GE(bicgstab[i], gmres[i]);
        EXPECT_LE(bicgstab[i], 2 * gmres[i]);
    }
    EXPECT_GT(tail[2], 0);
    EXPECT_LE(tail[2], 35);
}

// Each look is told as it happens, and applications only grow.
TEST(Acceleration, ObserverSeesTheHistory) {
    Acceleration cube = uniform(0.9);
    for (const NamedSolver& solver : solvers()) {
        Problem problem = cube.problem();
        problem.tolerance = 1e-4;
        problem.radius = 0.9;
        std::vector<SolverStep> seen;
        problem.observer = [&](const SolverStep& step) { seen.push_back(step); };
        const SolverResult result = solver.solve(problem);
        ASSERT_EQ(seen.size(), result.history.size()) << solver.name;
        ASSERT_FALSE(seen.empty()) << solver.name;
        for (std::size_t i = 1; i < seen.size(); ++i) {
            EXPECT_GE(seen[i].applications, seen[i - 1].applications) << solver.name;
            EXPECT_GE(seen[i].seconds, seen[i - 1].seconds) << solver.name;
        }
        EXPECT_NEAR(seen.back().applications, result.applications, 1e-9) << solver.name;
        EXPECT_LE(seen.back().estimate, 1e-4) << solver.name;
        EXPECT_LE(seen.back().error, 1e-3) << solver.name;
    }
}

// All of them, stopped by their own estimate: the answer is what they say, to ten times the tolerance.
TEST(Acceleration, AllStopWhereTheySay) {
    Acceleration cube = uniform(0.9);
    Problem problem = cube.problem();
    problem.tolerance = 1e-8;
    problem.radius = 0.9;
    problem.lowest = -0.35;
    problem.most = 5000;
    for (const NamedSolver& solver : solvers()) {
        const SolverResult result = solver.solve(problem);
        EXPECT_EQ(result.verdict, Verdict::converged) << solver.name << ": " << result.why;
        EXPECT_LE((result.x - *problem.exact).lpNorm<Eigen::Infinity>(), 1e-7 * problem.exact->lpNorm<Eigen::Infinity>())
            << solver.name;
        EXPECT_LE(result.applications, 5000) << solver.name;
    }
}

}  // namespace neumann::acceleration_test
