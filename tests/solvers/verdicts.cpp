// What every solver has to say of problems whose spectrum and sum are known exactly, with the spectral radius given and without. A
// series diverges where the radius is 1 or more, and nowhere else: not where terms alternate, stay for long or grow before they
// fall, nor where they are down to rounding.
#include "operators/experiments/known/small_problems.h"
#include "operators/solvers/series_run.h"
#include "operators/solvers/series_solvers.h"
#include "operators/solvers/solvers.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <numbers>

namespace neumann::verdicts_test {

using namespace known;

using Matrix = DenseChannel::Matrix;

DenseChannel equal_measures(const Matrix& K) { return {K, Vector::Ones(K.rows())}; }

// Two rooms of n facing patches, each of which sees all of the other room alike: eigenvalues ±λ, and 0. n = 1: two patches.
DenseChannel facing(double lambda, Eigen::Index n = 1) {
    Matrix K = Matrix::Zero(2 * n, 2 * n);
    K.topRightCorner(n, n).setConstant(lambda / static_cast<double>(n));
    K.bottomLeftCorner(n, n).setConstant(lambda / static_cast<double>(n));
    return equal_measures(K);
}

// One patch of the first room emits: L = e_0 + (λ² in its own room, λ in the other one) / (n (1 − λ²)).
Vector facing_sum(double lambda, Eigen::Index n = 1) {
    const double part = 1.0 / (static_cast<double>(n) * (1.0 - lambda * lambda));
    Vector L(2 * n);
    L << Vector::Constant(n, lambda * lambda * part), Vector::Constant(n, lambda * part);
    L[0] += 1.0;
    return L;
}

// Light behind m mirrors, which lose nothing.
DenseChannel periscope(Eigen::Index m) {
    Matrix K = Matrix::Zero(m + 1, m + 1);
    for (Eigen::Index u = 0; u < m; ++u) K(u + 1, u) = 1.0;
    return equal_measures(K);
}

struct Known {
    std::string name;
    DenseChannel K;
    Vector Le;
    double radius;
    std::optional<Vector> L;            // none where the series diverges
    std::optional<double> albedo = {};  // of all unknowns, where K = ρ F with F reciprocal
    double tolerance = 1e-8;
    Eigen::Index most = 3000;
    double not_normal = 1.0;  // ‖(I − K)⁻¹‖∞ (1 − radius), which no estimate knows of
    // Who does not end as the series does, and in which ways that is right: why is in the comments of each case.
    std::map<std::string, std::vector<Verdict>> others = {};
};

Problem problem_of(const Known& known, const Vector& reflectance) {
    Problem problem;
    problem.K = &known.K;
    problem.Le = known.Le;
    problem.tolerance = known.tolerance;
    problem.most = known.most;
    if (known.albedo) problem.reflectance = &reflectance;
    return problem;
}

// `usual`: of all that are not named in the case.
void expect_verdicts(const Known& known, const std::vector<Verdict>& usual) {
    const Vector reflectance = Vector::Constant(known.Le.size(), known.albedo.value_or(0.0));
    Problem problem = problem_of(known, reflectance);
    for (const bool radius_given : {false, true}) {
        if (radius_given) problem.radius = known.radius;
        for (const NamedSolver& solver : solvers()) {
            const std::string who = solver.name;
            const SolverResult result = solver.solve(problem);
            const std::string description =
                fmt::format("{}, radius {}: {}: {}: {}", known.name, radius_given ? "given" : "not given", who,
                            name(result.verdict), result.why);
            EXPECT_FALSE(result.why.empty()) << description;
            std::vector<Verdict> right = usual;
            if (known.others.contains(who)) right = known.others.at(who);
            if ((who == "chebyshev" && !radius_given) || (who == "cg" && !known.albedo)) right = {Verdict::refused};
            EXPECT_NE(std::find(right.begin(), right.end(), result.verdict), right.end()) << description;
            if (result.verdict == Verdict::converged || result.verdict == Verdict::rounding) {
                ASSERT_TRUE(known.L) << description;
                const double error = (result.x - *known.L).lpNorm<Eigen::Infinity>() / known.L->lpNorm<Eigen::Infinity>();
                EXPECT_LE(error, known.not_normal * std::max(10.0 * known.tolerance, 1e-13 / (1.0 - known.radius))) << description;
            }
            if (result.verdict == Verdict::diverging) {
                EXPECT_FALSE(known.L) << description;
            }
        }
    }
}

using enum Verdict;

// Terms go to and fro, and fall by λ each time. The ratio of neighbours is infinite, or 2.6 λ: there is none below 1 for the tail,
// nor for Aitken's, and the plain sum gets there. ±λ are equally large, so that there may be no single leading pair.
TEST(Verdicts, PairsOfEigenvalues) {
    for (const double lambda : {0.9, 0.909, 0.99, 0.999}) {
        Known known{fmt::format("±{}", lambda), facing(lambda), vector({1, 0}), lambda, facing_sum(lambda), lambda};
        known.most = 40000;
        known.others["eigenpair-tail"] = {converged, refused};
        expect_verdicts(known, {converged});
        known.Le = vector({1, 0.2});
        known.L = vector({1 + 0.2 * lambda, 0.2 + lambda}) / (1 - lambda * lambda);
        expect_verdicts(known, {converged});
        const SeriesRun run = run_series(known.K, known.Le, {.tolerance = 1e-8, .most_bounces = 40000});
        EXPECT_EQ(run.verdict, converged) << run.why;
        EXPECT_LE((run.sum - *known.L).lpNorm<Eigen::Infinity>(), 1e-7 * known.L->lpNorm<Eigen::Infinity>());
    }
    Known rooms{"rooms of ±0.9", facing(0.9, 50), Vector::Unit(100, 0), 0.9, facing_sum(0.9, 50), 0.9};
    rooms.others["eigenpair-tail"] = {converged, refused};
    expect_verdicts(rooms, {converged});
}

// No ratio is none to the end: what stands in for the limit is the sum, after as many terms as the series takes.
TEST(Verdicts, WhereNeighboursAlternateTheSumStandsIn) {
    const DenseChannel K = facing(0.909);
    Problem problem;
    problem.K = &K;
    problem.Le = vector({1, 0});
    problem.most = 10000;
    const SolverResult series = solve_neumann(problem), ratio = solve_ratio_tail(problem);
    EXPECT_EQ(ratio.verdict, converged);
    EXPECT_EQ(ratio.applications, series.applications);
    EXPECT_EQ(ratio.x, series.x);
    EXPECT_EQ(ratio.why,
              "the plain sum, its tail bounded, at the rate 0.909; extrapolated: the ratio of terms is inf: they do not "
              "fall by one ratio below 1");
}

// λ = 0.9999 and 0.5: the series has fallen to 0.74 after 3000 terms, and is not at its end; what extrapolates is.
TEST(Verdicts, SlowModes) {
    const double slow = 0.9999, fast = 0.5;
    Known known{"0.9999", two_by_two((slow + fast) / 2, (slow - fast) / 2, (slow - fast) / 2, (slow + fast) / 2, 1, 1),
                vector({1, 0}), slow, vector({(1 / (1 - slow) + 1 / (1 - fast)) / 2, (1 / (1 - slow) - 1 / (1 - fast)) / 2})};
    for (const char* slow_one : {"neumann", "gauss-seidel", "sor", "southwell"}) known.others[slow_one] = {limit};
    expect_verdicts(known, {converged});
    EXPECT_EQ(run_series(known.K, known.Le, {.tolerance = 1e-8, .most_bounces = 3000}).verdict, converged);  // it is enclosed
}

// Asked for 10⁻¹⁸ in numbers of 16 digits.
TEST(Verdicts, RoundingIsNoDivergence) {
    Known pair{"±0.9 to 1e-18", facing(0.9), vector({1, 0.2}), 0.9, vector({1.18, 1.1}) / 0.19, 0.9};
    Known disc{"dome to 1e-18", dome(), vector({1, 0}), (0.25 + std::sqrt(0.7625)) / 2, vector({0.75, 0.25}) / 0.575};
    Known rooms{"rooms of ±0.9 to 1e-18", facing(0.9, 50), Vector::Unit(100, 0), 0.9, facing_sum(0.9, 50), 0.9};
    for (Known* known : {&pair, &disc, &rooms})
        for (const double tolerance : {1e-18, 1e-300}) {
            known->tolerance = tolerance;
            known->others["eigenpair-tail"] = {rounding, refused};
            expect_verdicts(*known, {rounding});
            const SeriesRun run = run_series(known->K, known->Le, {.tolerance = tolerance, .most_bounces = 20000});
            EXPECT_EQ(run.verdict, rounding) << known->name << ": " << run.why;
            EXPECT_LE((run.sum - *known->L).lpNorm<Eigen::Infinity>(), 1e-13 * known->L->lpNorm<Eigen::Infinity>());
        }
}

// Albedo 1.05, and ±1.05: (I − K)⁻¹ Le is negative. Nobody takes it for the sum; the series says so, and by which radius.
TEST(Verdicts, Divergence) {
    for (const Known& known : {Known{"1.05", furnace(1.05), vector({1, 2, 3}), 1.05, std::nullopt, 1.05},
                               Known{"±1.05", facing(1.05), vector({1, 0}), 1.05, std::nullopt, 1.05},
                               Known{"rooms of ±1.05", facing(1.05, 50), Vector::Unit(100, 0), 1.05, std::nullopt, 1.05}}) {
        expect_verdicts(known, {diverging, refused});
        const Vector none;
        const SolverResult series = solve_neumann(problem_of(known, none));
        EXPECT_EQ(series.verdict, diverging);
        EXPECT_EQ(series.why, "the terms did not get smaller over the last 32 bounces, and the spectral radius is 1.05")
            << known.name;
        const SeriesRun run = run_series(known.K, known.Le);
        EXPECT_EQ(run.verdict, diverging) << run.why;
        EXPECT_NE(run.why.find("the spectral radius is 1.05"), std::string::npos) << run.why;
    }
}

// Albedo 1 in a closed room: there is no L. Without the radius, some can only say that they came to no end.
TEST(Verdicts, RadiusOne) {
    for (const Known& known : {Known{"1", furnace(1.0), vector({1, 2, 3}), 1.0, std::nullopt, 1.0},
                               Known{"±1", facing(1.0), vector({1, 0}), 1.0, std::nullopt, 1.0},
                               Known{"rooms of ±1", facing(1.0, 50), Vector::Unit(100, 0), 1.0, std::nullopt, 1.0}}) {
        expect_verdicts(known, {diverging, refused, broke_down, limit});
        const Vector none;
        Problem problem = problem_of(known, none);
        EXPECT_EQ(solve_neumann(problem).why,
                  "the terms did not get smaller over the last 32 bounces, and the spectral radius is 1");
        problem.radius = 1.0;
        for (const NamedSolver& solver : solvers()) EXPECT_NE(solver.solve(problem).verdict, limit) << solver.name;
    }
}

// Three mirrors in a ring, λ = 0.95 e^{2πik/3}, and values that are turned by 90° and 30°, λ = 0.95 e^{±iφ}: there Le = (1, 0)
// gives L = (1 − 0.95 cos φ, 0.95 sin φ) / |1 − λ|². Chebyshev's polynomials are those of a real interval, one leading pair is no
// single one; and relaxation grows where its own radius is above 1, which is so for some K with negative entries: at 90° that
// by 1.2, for (μ + 0.2)² = −1.44 · 0.95² μ has μ = −1.68, and at 30° all of it, Gauss-Seidel's being (sin φ / (1/0.95 − cos φ))²
// = 7.2.
TEST(Verdicts, ComplexPairs) {
    const double r = 0.95;
    Known ring{"ring", carousel(r), vector({1, 0, 0}), r, vector({1, r, r * r}) / (1 - r * r * r), r};
    ring.others["cg"] = {refused};
    ring.others["chebyshev"] = {broke_down};
    ring.others["eigenpair-tail"] = {converged, refused};
    expect_verdicts(ring, {converged});
    for (const double degrees : {90.0, 30.0}) {
        const double phi = degrees * std::numbers::pi / 180, c = r * std::cos(phi), s = r * std::sin(phi);
        Known turned{fmt::format("turned by {}°", degrees), two_by_two(c, -s, s, c, 1, 1), vector({1, 0}), r,
                     vector({1 - c, s}) / ((1 - c) * (1 - c) + s * s)};
        turned.others["chebyshev"] = {broke_down};
        turned.others["eigenpair-tail"] = {refused};
        turned.others["sor"] = {broke_down};
        if (degrees == 30.0) turned.others["gauss-seidel"] = turned.others["southwell"] = {broke_down};
        expect_verdicts(turned, {converged});
    }
}

// K² = 0; a defective eigenvalue; terms that grow for a hundred bounces before they fall; light that stays as it is behind forty
// mirrors. A pair of vectors of a defective eigenvalue has ⟨w, v⟩ = 0, BiCGSTAB's coefficients may be 0/0 away from symmetry, and
// of 1 − 0.99 and 100 elimination loses eight digits.
TEST(Verdicts, WhatIsNotNormal) {
    Known ends{"K² = 0", two_by_two(0, 0.7, 0, 0, 1, 2), vector({1, 1}), 0.0, vector({1.7, 1})};
    Known defective{"defective", two_by_two(0.5, 1, 0, 0.5, 1, 1), vector({1, 1}), 0.5, vector({6, 2})};
    Known growing{"growing", two_by_two(0.99, 100, 0, 0.99, 1, 1), vector({1, 1}), 0.99, vector({1000100, 100})};
    Known mirrors{"forty mirrors", periscope(40), Vector::Unit(41, 0), 0.0, Vector::Ones(41)};
    Known many{"a hundred mirrors", periscope(100), Vector::Unit(101, 0), 0.0, Vector::Ones(101)};
    for (Known* known : {&ends, &defective, &growing, &mirrors, &many}) {
        known->others["eigenpair-tail"] = {converged, broke_down, refused, limit};  // finding none may take all that was allowed
        known->others["bicgstab"] = {converged, broke_down};
        if (known == &growing) {
            known->others["lu"] = {rounding};
            known->not_normal = 1e6 * 0.01;
        }
        expect_verdicts(*known, {converged});
        const SeriesRun run = run_series(known->K, known->Le, {.tolerance = 1e-8});
        EXPECT_EQ(run.verdict, converged) << known->name << ": " << run.why;
        EXPECT_LE((run.sum - *known->L).lpNorm<Eigen::Infinity>(), 1e-7 * known->L->lpNorm<Eigen::Infinity>()) << known->name;
    }
}

// Nothing emits: L = 0 in a room where light would last, and where it would grow.
TEST(Verdicts, Darkness) {
    for (const double lambda : {0.999, 1.05}) {
        const DenseChannel K = facing(lambda);
        Problem problem;
        problem.K = &K;
        problem.Le = Vector::Zero(2);
        for (const NamedSolver& solver : solvers()) {
            const SolverResult result = solver.solve(problem);
            const bool answers = result.verdict == converged;
            EXPECT_TRUE(answers || result.verdict == refused) << solver.name << ": " << result.why;
            EXPECT_EQ(result.x, Vector::Zero(2)) << solver.name;
        }
    }
}

}  // namespace neumann::verdicts_test
