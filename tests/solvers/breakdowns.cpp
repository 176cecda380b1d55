// Where methods have no answer, or one that must not be believed.
#include "operators/experiments/known/cube.h"
#include "operators/experiments/known/small_problems.h"
#include "operators/solvers/chebyshev.h"
#include "operators/solvers/krylov.h"
#include "operators/solvers/lu.h"
#include "operators/solvers/relaxation.h"
#include "operators/solvers/series_solvers.h"
#include "operators/solvers/side_by_side.h"
#include "operators/solvers/solvers.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace neumann::breakdowns_test {

using namespace known;

Problem problem_of(const DenseChannel& K, const Vector& Le) {
    Problem problem;
    problem.K = &K;
    problem.Le = Le;
    problem.tolerance = 1e-8;
    problem.most = 2000;
    return problem;
}

// A furnace of albedo 1.05: (I − K)⁻¹ Le = −20, which elimination, Krylov methods and extrapolation find without noticing.
TEST(Breakdowns, NobodyAnswersADivergentSeries) {
    const DenseChannel K = furnace(1.05);
    const Vector rho = Vector::Constant(3, 1.05);
    Problem problem = problem_of(K, Vector::Ones(3));
    problem.reflectance = &rho;
    for (const bool radius_known : {false, true}) {
        if (radius_known) problem.radius = 1.05;
        for (const NamedSolver& solver : solvers()) {
            const SolverResult result = solver.solve(problem);
            EXPECT_TRUE(result.verdict == Verdict::refused || result.verdict == Verdict::diverging)
                << solver.name << ": " << name(result.verdict) << ", " << result.why;
            EXPECT_FALSE(result.why.empty()) << solver.name;
        }
    }
    problem.radius.reset();
    for (const char* solver : {"aitken", "wynn", "vector-epsilon", "gmres", "bicgstab", "lu"}) {
        const SolverResult result = find_solver(solver)->solve(problem);
        EXPECT_EQ(result.verdict, Verdict::refused) << solver;
        EXPECT_NEAR(result.x[0], -20.0, 1e-6) << solver;
        EXPECT_EQ(result.why, "negative radiance, -20: the series diverges, and this solves (I − K) L = Le without being its sum")
            << solver;
    }
    EXPECT_EQ(find_solver("ratio-tail")->solve(problem).why,
              "the terms did not get smaller over the last 32 bounces, and the spectral radius is 1.05");
    EXPECT_EQ(find_solver("cg")->solve(problem).why, "I − K is not positive definite: the spectral radius of K is 1 or more");
}

// Period 3: K^i Le is 0.9^i at one unknown in turn and 0 at the others. L = 0.9^k/(1 − 0.729).
TEST(Breakdowns, PeriodThree) {
    const DenseChannel K = carousel(0.9);
    Problem problem = problem_of(K, vector({1, 0, 0}));
    const Vector exact = vector({1, 0.9, 0.81}) / (1 - 0.729);
    problem.exact = &exact;
    problem.most = 30;
    const SolverResult aitken = solve_aitken(problem), ratio = solve_ratio_tail(problem);
    EXPECT_EQ(aitken.verdict, Verdict::broke_down);
    EXPECT_EQ(aitken.why, "no ratio of terms at 1 of 3 unknowns: a term is 0, or equal to the one before");
    EXPECT_EQ(ratio.verdict, Verdict::refused);
    for (const char* solver : {"vector-epsilon", "gmres", "gauss-seidel", "lu", "neumann"}) {
        problem.most = 2000;
        const SolverResult result = find_solver(solver)->solve(problem);
        EXPECT_EQ(result.verdict, Verdict::converged) << solver << ": " << result.why;
        EXPECT_LE((result.x - exact).lpNorm<Eigen::Infinity>(), 1e-7) << solver;
    }
    // K is not diag(ρ) F with a reciprocal F.
    const Vector rho = Vector::Constant(3, 0.9);
    problem.reflectance = &rho;
    const SolverResult cg = solve_conjugate_gradients(problem);
    EXPECT_EQ(cg.verdict, Verdict::refused);
    EXPECT_NE(cg.why.find("K is not diag(ρ) F with F reciprocal"), std::string::npos) << cg.why;
}

// The eigenpair is paid for in applications like all else.
TEST(Breakdowns, AnEigenpairThatTakesAllApplications) {
    const DenseChannel K(plates().matrix(), Vector::Ones(2));
    Problem problem = problem_of(K, vector({1, 0}));
    problem.most = 1;
    const SolverResult result = find_solver("eigenpair-tail")->solve(problem);
    EXPECT_EQ(result.verdict, Verdict::limit);
    EXPECT_EQ(result.why, "finding the leading eigenpair took all applications that were allowed");
    EXPECT_EQ(result.x, problem.Le);
}

// Near-parallel plates, relative errors at the outer one after n terms. Aitken gains nothing over the plain sum,
// the ratio of terms is 22 … 1.4, and Wynn, with as many terms as there are modes, is exact.
TEST(Breakdowns, AlternatingTerms) {
    const DenseChannel K(plates().matrix(), Vector::Ones(2));
    Problem problem = problem_of(K, vector({1, 0}));
    problem.tolerance = 0.0;
    const Vector exact = vector({1 - .01791, .88209}) / (1 - .01791 - .9 * .88209);
    const auto error = [&](const Solver& solve, int n) {
        problem.most = n;
        return std::abs(solve(problem).x[1] / exact[1] - 1.0);
    };
    struct Row {
        int n;
        double plain, aitken, lambda;
    };
    for (const Row& row : {Row{4, 0.6535911100153163, 0.6533922783274924, 15.001795202760848},
                           Row{5, 0.5348291418665898, 0.659196936531767, 11.003802079313223},
                           Row{10, 0.34553574853669067, 0.3448779621515211, 5.042805355839391},
                           Row{40, 0.014376681667732316, 0.013929698920867373, 1.3800368659946993}}) {
        EXPECT_NEAR(error(solve_neumann, row.n), row.plain, 1e-12);
        EXPECT_NEAR(error(solve_aitken, row.n), row.aitken, 1e-12);
        EXPECT_LT(error(solve_wynn_epsilon, row.n), 1e-12);
        EXPECT_NEAR(error(solve_ratio_tail, row.n), row.plain, 1e-12);  // the plain sum stands in
        const SolverResult ratio = solve_ratio_tail(problem);
        EXPECT_EQ(ratio.verdict, Verdict::refused);
        EXPECT_NE(ratio.why.find(fmt::format("{:.4g}", row.lambda)), std::string::npos) << ratio.why;
    }
}

// Half of a sphere has albedo 1.6: ‖K‖∞ = 1.6, yet the mean albedo 0.9 decides. L = 1 + ρ/(1 − 0.9) = 17 and 3.
TEST(Breakdowns, NormAboveOneConverges) {
    const DenseChannel K = sphere_halves(1.6, 0.2);
    const Vector rho = vector({1.6, 0.2});
    Problem problem = problem_of(K, Vector::Ones(2));
    problem.reflectance = &rho;
    problem.radius = 0.9;
    problem.lowest = 0.0;
    for (const NamedSolver& solver : solvers()) {
        const SolverResult result = solver.solve(problem);
        EXPECT_EQ(result.verdict, Verdict::converged) << solver.name << ": " << result.why;
        EXPECT_NEAR(result.x[0], 17.0, 1e-6) << solver.name;
        EXPECT_NEAR(result.x[1], 3.0, 1e-6) << solver.name;
    }
    const DenseChannel above = sphere_halves(2.0, 0.2);
    problem.K = &above;
    problem.radius.reset();
    for (const NamedSolver& solver : solvers()) {
        const SolverResult result = solver.solve(problem);
        EXPECT_TRUE(result.verdict == Verdict::refused || result.verdict == Verdict::diverging)
            << solver.name << ": " << result.why;
    }
}

TEST(Breakdowns, DarkScenesAndEmptyOnes) {
    const DenseChannel K = furnace(0.5), nothing(DenseChannel::Matrix(0, 0), Vector(0));
    const Vector rho = Vector::Constant(3, 0.5), none(0);
    for (const NamedSolver& solver : solvers()) {
        Problem problem = problem_of(K, Vector::Zero(3));
        problem.radius = 0.5;
        problem.reflectance = &rho;
        const SolverResult dark = solver.solve(problem);
        EXPECT_EQ(dark.verdict, Verdict::converged) << solver.name << ": " << dark.why;
        EXPECT_EQ(dark.x, Vector::Zero(3)) << solver.name;
        problem.K = &nothing;
        problem.Le = Vector(0);
        problem.reflectance = &none;
        EXPECT_EQ(solver.solve(problem).x.size(), 0) << solver.name;
    }
    const DenseChannel black = furnace(0.0);
    const Vector zero = Vector::Zero(3);
    for (const NamedSolver& solver : solvers()) {
        Problem problem = problem_of(black, vector({1, 2, 3}));
        problem.radius = 0.0;
        problem.lowest = -0.1;  // Chebyshev needs an interval
        problem.reflectance = &zero;
        const SolverResult result = solver.solve(problem);
        EXPECT_EQ(result.verdict, Verdict::converged) << solver.name << ": " << result.why;
        EXPECT_LE((result.x - vector({1, 2, 3})).lpNorm<Eigen::Infinity>(), 1e-7) << solver.name;
    }
}

// Radiance 1e30 or 1e-30: the same number of applications.
TEST(Breakdowns, BrightnessDoesNotMatter) {
    const DenseChannel K = dome();
    const Vector rho = vector({0.7, 0.5});
    for (const NamedSolver& solver : solvers()) {
        Problem problem = problem_of(K, vector({1, 0}));
        problem.radius = 0.5616062299;
        problem.reflectance = &rho;
        const SolverResult one = solver.solve(problem);
        for (const int k : {-100, 100}) {
            problem.Le = std::ldexp(1.0, k) * vector({1, 0});
            const SolverResult scaled = solver.solve(problem);
            EXPECT_EQ(scaled.verdict, one.verdict) << solver.name;
            EXPECT_EQ(scaled.applications, one.applications) << solver.name << " 2^" << k;
            EXPECT_EQ(scaled.x * std::ldexp(1.0, -k), one.x) << solver.name << " 2^" << k;
        }
    }
}

TEST(Breakdowns, WhatAMethodNeedsIsAskedFor) {
    const DenseChannel K = dome();
    const Problem problem = problem_of(K, vector({1, 0}));
    EXPECT_EQ(solve_chebyshev(problem).why, "needs the spectral radius");
    EXPECT_EQ(solve_chebyshev(problem, -1.0, 1.0).why, "needs lowest ≤ highest < 1 for the eigenvalues of K, not [-1, 1]");
    EXPECT_EQ(solve_conjugate_gradients(problem).why,
              "needs the reflectance ρ of each unknown, with K = diag(ρ) F and F reciprocal");
    EXPECT_EQ(solve_lu(problem, 10.0).why, "2 unknowns need 6.4e-08 GB, 1e-08 are allowed");
    Problem wrong = problem;
    wrong.Le = vector({1, 0, 0});
    EXPECT_THROW(solve_neumann(wrong), std::invalid_argument);
    EXPECT_EQ(find_solver("conjugate"), nullptr);
}

// Black patches have no place in the inner product of CG, and light of their own all the same.
TEST(Breakdowns, ConjugateGradientsWithBlackPatches) {
    const DenseChannel K = two_by_two(0.0, 0.7, 0.0, 0.0, 1.0, 2.0);
    const Vector rho = vector({0.7, 0.0});
    Problem problem = problem_of(K, vector({0, 1}));
    problem.reflectance = &rho;
    const SolverResult result = solve_conjugate_gradients(problem);
    EXPECT_EQ(result.verdict, Verdict::converged);
    EXPECT_NEAR(result.x[0], 0.7, 1e-15);
    EXPECT_EQ(result.x[1], 1.0);
    EXPECT_EQ(result.setup, 2.0);  // one for the light of their own, one that bounds errors
}

// Whoever has had enough waits for no solver's end: nothing is asked of K once it was said, and the rows until then are kept.
TEST(SideBySide, EndsAtTheNextUseOfK) {
    const Cube cube = symmetric_cube(4);
    const DenseChannel K = cube.channel(0.99);
    const Problem problem = problem_of(K, Vector::Ones(K.size()));
    int asked = 0;
    const auto patient_for = [&](int uses) {
        asked = 0;
        return solve_side_by_side(problem, false, {.stop = [&asked, uses] { return asked++ >= uses; }});
    };
    const SideBySide all = patient_for(std::numeric_limits<int>::max());
    EXPECT_FALSE(all.interrupted);
    EXPECT_EQ(all.rows.size(), solvers().size());
    for (const int uses : {0, 5, asked / 2, asked - 1}) {
        const SideBySide some = patient_for(uses);
        EXPECT_EQ(asked, uses + 1);
        EXPECT_TRUE(some.interrupted);
        ASSERT_LT(some.rows.size(), all.rows.size());
        for (std::size_t i = 0; i < some.rows.size(); ++i) EXPECT_EQ(some.rows[i].result.x, all.rows[i].result.x);
    }
}

}  // namespace neumann::breakdowns_test
