// What every solver says of its error, where most of what it sees falls fast and the little that is left falls slowly, and where
// nothing falls for long: rates that are seen are not those that are there.
#include "operators/experiments/known/small_problems.h"
#include "operators/solvers/inverse_bound.h"
#include "operators/solvers/series_run.h"
#include "operators/solvers/solvers.h"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include <random>
#include <string>

namespace neumann::estimates_test {

using namespace known;

using Matrix = DenseChannel::Matrix;

// Two rooms of 60 unknowns, which lose 1 − rho; a part of the light of each goes to the other. Reciprocal, with equal measures.
Matrix two_rooms(double fast, double slow, double coupling) {
    const Eigen::Index n = 60;
    std::mt19937_64 bits(7);
    std::uniform_real_distribution<double> uniform(0.5, 1.5);
    Matrix F = Matrix::Zero(2 * n, 2 * n);
    for (Eigen::Index u = 0; u < 2 * n; ++u)
        for (Eigen::Index v = 0; v <= u; ++v) {
            const bool same = (u < n) == (v < n);
            F(u, v) = F(v, u) = uniform(bits) * (same ? 1.0 : coupling);
        }
    F /= F.rowwise().sum().maxCoeff();
    F.diagonal() += (Vector::Ones(2 * n) - F.rowwise().sum()).eval();
    Vector rho(2 * n);
    rho << Vector::Constant(n, fast), Vector::Constant(n, slow);
    return rho.asDiagonal() * F;
}

struct Case {
    const char* name;
    Matrix K;
    Vector Le;
    std::optional<Vector> reflectance = {};
};

std::vector<Case> cases() {
    std::vector<Case> all;
    for (const double slow : {0.97, 0.999}) {
        Vector rho(120), Le = Vector::Zero(120);
        rho << Vector::Constant(60, 0.3), Vector::Constant(60, slow);
        Le.head(10).setOnes();
        all.push_back({"two rooms", two_rooms(0.3, slow, 1e-4), Le, rho});
        Le.tail(60).setConstant(1e-7);
        all.push_back({"two rooms, apart", two_rooms(0.3, slow, 0.0), Le, rho});
    }
    Matrix ring = Matrix::Zero(200, 200);
    for (Eigen::Index u = 0; u < 200; ++u) ring((u + 1) % 200, u) = 0.999;
    all.push_back({"a ring of mirrors", ring, Vector::Unit(200, 0)});
    all.push_back({"a ring of mirrors, lit everywhere", ring, Vector::LinSpaced(200, 0.5, 1.5)});
    return all;
}

// By elimination with 64 bits of mantissa.
Vector exact_sum(const Matrix& K, const Vector& Le) {
    using Long = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
    const Long A = Long::Identity(K.rows(), K.cols()) - K.cast<long double>();
    return A.partialPivLu().solve(Le.cast<long double>()).cast<double>();
}

TEST(EstimatesSlow, AreNoneBelowAThirdOfTheError) {
    constexpr double tolerance = 1e-6;
    for (const Case& problem_of : cases()) {
        const SparseChannel K(problem_of.K.sparseView(), Vector::Ones(problem_of.K.rows()));
        const Vector L = exact_sum(problem_of.K, problem_of.Le);
        const auto error_of = [&](const Vector& x) { return (x - L).lpNorm<Eigen::Infinity>() / L.lpNorm<Eigen::Infinity>(); };
        Problem problem;
        problem.K = &K;
        problem.Le = problem_of.Le;
        problem.tolerance = tolerance;
        problem.most = 40000;
        if (problem_of.reflectance) problem.reflectance = &*problem_of.reflectance;
        for (const bool radius_given : {false, true}) {
            if (radius_given) problem.radius = problem_of.K.rowwise().sum().maxCoeff();  // a bound on it, and nearly the radius
            for (const NamedSolver& solver : solvers()) {
                const std::string who = solver.name;
                const bool is_quick = who.starts_with("anderson") || who == "gmres" || who == "bicgstab" || who == "chebyshev";
                if (radius_given && !is_quick) continue;
                const SolverResult result = solver.solve(problem);
                const std::string description =
                    std::string(problem_of.name) + ", " + who + ": " + name(result.verdict) + ": " + result.why;
                if (who == "neumann" || who == "gauss-seidel" || who == "southwell" || who == "gmres" || who == "lu") {
                    EXPECT_EQ(result.verdict, Verdict::converged) << description << ": an estimate of those that refuse is no test";
                }
                if (result.verdict != Verdict::converged && result.verdict != Verdict::rounding) continue;
                EXPECT_GE(result.history.back().estimate, error_of(result.x) / 3.0) << description;
                if (result.verdict == Verdict::converged) {
                    EXPECT_LE(error_of(result.x), 3.0 * tolerance) << description;
                }
            }
        }
        const SeriesRun run = run_series(K, problem_of.Le, {.tolerance = tolerance, .most_bounces = 40000});
        EXPECT_EQ(run.verdict, Verdict::converged) << problem_of.name << ": " << run.why;
        EXPECT_LE(error_of(run.sum), tolerance) << problem_of.name << ": " << run.why;
    }
}

// ‖(I − K)⁻¹‖∞ for K ≥ 0 is the largest row sum of the inverse.
TEST(Estimates, BoundsOfTheInverse) {
    const auto expect_bound = [](const Matrix& K, double factor, double applications) {
        const InverseBound bound = bound_inverse(DenseChannel(K, Vector::Ones(K.rows())));
        const double right = exact_sum(K, Vector::Ones(K.rows())).maxCoeff();
        EXPECT_GE(bound.norm, right * (1.0 - 1e-9));
        EXPECT_LE(bound.norm, right * factor);
        EXPECT_LE(bound.applications, applications);
    };
    expect_bound(furnace(0.9999).matrix(), 1.0 + 1e-9, 1.0);
    expect_bound(sphere_halves(1.6, 0.2).matrix(), 2.0, 2.0);  // ‖K‖∞ = 1.6 bounds nothing
    expect_bound(dome().matrix(), 2.0, 8.0);
    for (const Case& problem_of : cases()) expect_bound(problem_of.K, 2.0, 8.0);
    EXPECT_TRUE(std::isinf(bound_inverse(furnace(1.0)).norm));
    EXPECT_TRUE(std::isinf(bound_inverse(furnace(1.05)).norm));
    EXPECT_EQ(bound_inverse(furnace(0.0)).norm, 1.0);
}

}  // namespace neumann::estimates_test
