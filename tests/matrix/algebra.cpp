// The algebra on patches: what its types allow, adjoints and entries of whole expressions, and I − R T handed to every solver.
#include "operators/algebra/neumann_series.h"
#include "operators/experiments/known/enclosures.h"
#include "operators/fields/matrix/inner_product.h"
#include "operators/fields/matrix/light_vector.h"
#include "operators/fields/matrix/scene_patches.h"
#include "operators/fields/matrix/traced_channel.h"
#include "operators/solvers/lu.h"
#include "operators/solvers/matrix_channel.h"
#include "operators/solvers/side_by_side.h"
#include "operators/solvers/spectrum/spectrum.h"

#include <gtest/gtest.h>
#include <set>

namespace neumann::algebra_test {

using namespace known;
using T1 = TransportMatrix<1>;
using R1 = ReflectionMatrix<1>;
using Bounce = Product<R1, T1>;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

template <class A, class B>
concept Multiply = requires(A a, B b) {
    a* b;
};
template <class A, class B>
concept Subtract = requires(A a, B b) {
    a - b;
};
template <class A, class F>
concept Solvable = requires(const A a, const F Le, const Vector m, const Solver solver) {
    solve(a, Le, m, solver);
};
using OnExitant = Identity<ExitantVector<1>>;
using OnIncident = Identity<IncidentVector<1>>;
static_assert(Multiply<R1, T1> && Multiply<T1, R1> && !Multiply<T1, T1> && !Multiply<R1, R1>);
static_assert(!Multiply<ReflectionMatrix<4>, T1>);
static_assert(Subtract<OnExitant, Bounce> && !Subtract<OnIncident, Bounce> && !Subtract<R1, T1>);
static_assert(Subtract<ExitantVector<1>, ExitantVector<1>> && !Subtract<ExitantVector<1>, IncidentVector<1>>);
static_assert(!std::constructible_from<ExitantVector<1>, IncidentVector<1>>);
static_assert(!std::convertible_to<ExitantVector<1>::Values, ExitantVector<1>>);
static_assert(std::same_as<decltype(adjoint(std::declval<T1>()))::Range, ExitantVector<1>>);
static_assert(HasRows<Difference<OnExitant, Bounce>> && Adjointable<Difference<OnExitant, Bounce>>);
// What the solvers take is I − K, K of one channel.
static_assert(Solvable<Difference<OnExitant, Bounce>, ExitantVector<1>> && !Solvable<Bounce, ExitantVector<1>>);
static_assert(!Solvable<Difference<OnExitant, Bounce>, IncidentVector<1>>);
static_assert(
    !Solvable<Difference<Identity<ExitantVector<4>>, Product<ReflectionMatrix<4>, TransportMatrix<4>>>, ExitantVector<4>>);

// A room with a mirror, a rough floor and a lamp on a wall, as its unknowns: directions and patches.
Scene shiny_room(double rho = 0.7) {
    SceneMaker maker;
    const auto walls = room({-1, -1, -1}, {1, 1, 1});
    for (const std::size_t face : {right, front, ceiling}) maker.add(walls[face], matte(rho));
    maker.add(walls[left], glowing(0.5 * rho, 1.0));
    maker.add(walls[back], made_of(Conductor({}, Rgb(0.9))));
    maker.add(walls[floor], made_of(RoughConductor<Ggx>(Ggx(0.4), {}, Rgb(0.8))));
    return maker.make();
}
Scene matte_room() {
    SceneMaker maker;
    const auto walls = room({-1, -1, -1}, {1, 1, 1});
    const double rho[6] = {0.2, 0.8, 0.5, 0.9, 0.4, 0.7};
    for (std::size_t i = 0; i < 5; ++i) maker.add(walls[i], matte(rho[i]));
    maker.add(walls[5], glowing(rho[5], 1.0));
    maker.add(box({0.1, 0.2, -0.9}, {0.5, 0.6, 0.1}), matte(0.6));
    return maker.make();
}

struct System {
    System(const Scene& scene, std::size_t patches, std::uint32_t rays)
        : space(scene_patches(scene, {.patches = patches})),
          table(space, rays, 1),
          T(table),
          R(scene.materials, space),
          Le(emitted_light<1>(scene, space)) {}
    // R T as matrices, multiplied by Eigen.
    SparseChannel formed() const { return {reflection_matrix(table, R) * transport_matrix(table), measure(space)}; }
    Vector vector(double a, double b) const {
        Vector x(space.size());
        for (Eigen::Index u = 0; u < x.size(); ++u) x[u] = std::sin(a + b * static_cast<double>(u));
        return x;
    }

    PatchSpace space;
    RayTable table;
    T1 T;
    R1 R;
    ExitantVector<1> Le;
};

// Every kind of expression: I, sums, differences, multiples and products of products.
template <class K>
auto expression(const K& k) {
    const Identity<typename K::Domain> I;
    return I - 0.3 * k + (k - 2.0 * I) * (0.25 * k * k);
}

TEST(Algebra, ExpressionsAreWhatTheySay) {
    const System s(shiny_room(), 40, 32);
    const SparseChannel K = s.formed();
    ASSERT_GT(s.space.size(), s.space.facets().size());
    const Vector x = s.vector(1.0, 3.0);
    const auto times = [&](const Vector& f) {
        Vector y(f.size());
        K.apply(f, y);
        return y;
    };
    const Vector Kx = times(x), KKx = times(Kx);
    const Vector expected = x - 0.3 * Kx + 0.25 * (times(KKx) - 2.0 * KKx);
    const Vector found = to_vector(expression(s.R * s.T)(ExitantVector<1>(x)));
    EXPECT_LE((found - expected).lpNorm<Eigen::Infinity>(), 1e-13);
    EXPECT_GE((found - x).lpNorm<Eigen::Infinity>(), 0.1);
}

TEST(Algebra, AdjointsOfExpressionsPassTheDotTest) {
    const System s(shiny_room(), 40, 32);
    const auto A = expression(s.R * s.T);
    const ExitantVector<1> f(s.vector(1.0, 3.0)), g(s.vector(2.0, 5.0));
    const double Af_g = inner_product(s.space, A(f), g)[0], f_Ag = inner_product(s.space, f, adjoint(A)(g))[0];
    const double size = std::sqrt(inner_product(s.space, f, f)[0] * inner_product(s.space, g, g)[0]);
    EXPECT_NEAR(Af_g, f_Ag, 1e-14 * size);
    // A is not its own adjoint, so that this could fail.
    EXPECT_GT(std::abs(Af_g - inner_product(s.space, f, A(g))[0]), 1e-6 * size);
    const double twice = inner_product(s.space, adjoint(adjoint(A))(f), g)[0];
    EXPECT_EQ(twice, Af_g);
}

// An entry of K³ comes in some hundred parts; 1e-13 is 450 ε.
TEST(Algebra, EntriesOfExpressionsAreThoseOfTheirMatrix) {
    const System s(shiny_room(), 20, 16);
    const auto A = expression(s.R * s.T);
    const OperatorChannel channel(A, measure(s.space));
    const auto n = static_cast<Eigen::Index>(s.space.size());
    const Vector x = s.vector(0.5, 7.0);
    Vector Ax(n), column(n);
    channel.apply(x, Ax);
    for (Eigen::Index u = 0; u < n; u += 61) {
        EXPECT_NEAR(channel.row(u, x), Ax[u], 1e-13);
        channel.apply(Vector::Unit(n, u), column);
        EXPECT_NEAR(channel.diagonal(u), column[u], 1e-13);
        Vector added = Vector::Zero(n);
        channel.add_column(u, 2.0, added);
        EXPECT_LE((added - 2.0 * column).lpNorm<Eigen::Infinity>(), 1e-13);
    }
}

// L = 1/(1 − ρ) wherever one looks: in every enclosure, whatever the solver.
TEST(Algebra, AnySolverTakesIMinusRT) {
    constexpr double rho = 0.7;
    const Identity<ExitantVector<1>> I;
    for (const ClosedScene& e : enclosures(Surface{Rgb(rho), AreaLight(Rgb(1.0)), false})) {
        const Scene scene = e.maker.make();
        const System s(scene, 60, 32);
        const Vector reflectance = Vector::Constant(s.space.size(), rho);
        for (const NamedSolver& solver : solvers()) {
            const SolverResult found = solve(I - s.R * s.T, s.Le, measure(s.space), solver.solve,
                                             {.tolerance = 1e-10, .radius = rho, .reflectance = &reflectance});
            EXPECT_EQ(found.verdict, Verdict::converged) << e.name << ", " << solver.name << ": " << found.why;
            EXPECT_LE((found.x.array() * (1.0 - rho) - 1.0).abs().maxCoeff(), 1e-9) << e.name << ", " << solver.name;
        }
    }
}

// Against the matrices multiplied, and solved by elimination.
TEST(Algebra, SolversAgreeWithElimination) {
    const Identity<ExitantVector<1>> I;
    for (const bool shiny : {false, true}) {
        const System s(shiny ? shiny_room() : matte_room(), 24, 16);
        const SparseChannel K = s.formed();
        const SolverResult exact = solve_lu({.K = &K, .Le = to_vector(s.Le)});
        ASSERT_EQ(exact.verdict, Verdict::converged);
        const double radius = spectral_radius(K), size = exact.x.lpNorm<Eigen::Infinity>();
        ASSERT_GT(size, 1.1);
        int answers = 0;
        for (const NamedSolver& solver : solvers()) {
            const SolverResult found =
                solve(I - s.R * s.T, s.Le, measure(s.space), solver.solve, {.tolerance = 1e-9, .radius = radius});
            if (found.verdict == Verdict::refused || found.verdict == Verdict::broke_down) continue;
            EXPECT_EQ(found.verdict, Verdict::converged) << solver.name << ": " << found.why;
            EXPECT_LE((found.x - exact.x).lpNorm<Eigen::Infinity>(), 1e-8 * size) << solver.name;
            ++answers;
        }
        EXPECT_GE(answers, 12) << "of 17; CG wants K = diag(ρ) F";
    }
}

// Li = T L solves Li = T Le + T R Li.
TEST(Algebra, IncidentFieldsAreSolvedForAlike) {
    const System s(matte_room(), 100, 16);
    const Identity<ExitantVector<1>> I;
    const Identity<IncidentVector<1>> J;
    const Problem how{.tolerance = 1e-13};
    const auto gmres = find_solver("gmres")->solve;
    const ExitantVector<1> L(solve(I - s.R * s.T, s.Le, measure(s.space), gmres, how).x);
    const Vector Li = solve(J - s.T * s.R, s.T(s.Le), measure(s.space), gmres, how).x;
    EXPECT_LE((Li - to_vector(s.T(L))).lpNorm<Eigen::Infinity>(), 1e-11);
    EXPECT_GT(Li.minCoeff(), 0.01);
}

// K that can only be applied, and one that has K* as well.
struct Opaque {
    using Domain = ExitantVector<1>;
    using Range = ExitantVector<1>;
    Range operator()(const Domain& f) const { return K(f); }
    Bounce K;
};
struct WithAdjoint : Opaque {
    Opaque adjoint() const { return *this; }
};

TEST(Algebra, SolversRefuseWhatTheyCannotAskOfK) {
    const System s(matte_room(), 100, 16);
    const Identity<ExitantVector<1>> I;
    const Opaque K{s.R * s.T};
    static_assert(!Adjointable<Opaque> && !HasRows<Opaque> && Adjointable<WithAdjoint>);
    const auto refused = [&](const auto& equation) {
        std::set<std::string> names;
        for (const NamedSolver& solver : solvers()) {
            if (solver.name == std::string("cg")) continue;  // wants reflectances
            const SolverResult found = solve(equation, s.Le, measure(s.space), solver.solve, {.tolerance = 1e-6});
            if (found.verdict == Verdict::refused && found.why.find("this K") != std::string::npos) names.insert(solver.name);
        }
        return names;
    };
    EXPECT_EQ(refused(I - K), (std::set<std::string>{"eigenpair-tail", "gauss-seidel", "lu", "sor", "southwell"}));
    EXPECT_EQ(refused(I - WithAdjoint{K}), (std::set<std::string>{"gauss-seidel", "lu", "sor", "southwell"}));
    EXPECT_EQ(refused(I - s.R * s.T), std::set<std::string>{});
    EXPECT_EQ(solve(I - K, s.Le, measure(s.space), find_solver("lu")->solve).why,
              "needs the entries of K, its rows and columns, and this K can only be applied");
    const OperatorChannel channel(K, measure(s.space));
    Vector y(s.space.size());
    EXPECT_THROW(channel.apply_adjoint(y, y), std::logic_error);
    EXPECT_THROW(channel.row(0, y), std::logic_error);
}

// Term 0 is 1, and every other adds half a unit in the last place: ordinary addition stays at 1.
TEST(Algebra, TheSeriesIsCompensated) {
    DenseChannel::Matrix m(2, 2);
    m << 0.0, 0x1p-53, 0.0, 1.0;
    struct Matrix {
        using Domain = ExitantVector<1>;
        using Range = ExitantVector<1>;
        Range operator()(const Domain& f) const { return Range(Vector(K * to_vector(f))); }
        DenseChannel::Matrix K;
    };
    NeumannSeries series(Matrix{m}, ExitantVector<1>(Vector(Vector::Ones(2))));
    for (int i = 0; i < 64; ++i) series.advance();
    EXPECT_EQ(series.sum()(0, 0), 1.0 + 0x1p-47);
    EXPECT_EQ(series.sum()(0, 1), 65.0);
    EXPECT_EQ(series.term()(0, 0), 0x1p-53);
    EXPECT_EQ(series.bounce(), 64);
}

}  // namespace neumann::algebra_test
