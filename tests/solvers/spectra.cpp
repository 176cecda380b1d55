// How eigenvalues and norms are found, and what is said where they are not. Known spectra are in
// operators/experiments/known/eigenvalues.cpp.
#include "operators/experiments/known/cube.h"
#include "operators/experiments/known/small_problems.h"
#include "operators/solvers/spectrum/closure.h"
#include "operators/solvers/spectrum/radius_bounds.h"
#include "operators/solvers/spectrum/rounding_floor.h"
#include "operators/solvers/spectrum/spectrum.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace neumann::spectra_test {

using namespace known;

// In a sphere each patch sends all others the same per area: K_uv = ρ a_v / Σ a, whatever the patches' sizes. No bounce leaves more
// of a patch's power than ρ, although the plain column of a large patch sums to nearly 5 ρ.
TEST(Spectra, NormOneIsOfPower) {
    Vector area(6);
    area << 1.0, 1e-6, 0.3, 20.0, 1e-3, 2.0;
    const double rho = 0.6;
    const DenseChannel::Matrix K = rho * Vector::Ones(6) * area.transpose() / area.sum();
    EXPECT_GT(K.colwise().sum().maxCoeff(), 3.0);
    const OperatorNorms norms = operator_norms(DenseChannel(K, area));
    EXPECT_NEAR(norms.one, rho, 1e-14);
    EXPECT_NEAR(norms.sup, rho, 1e-14);
    EXPECT_NEAR(norms.two, rho, 1e-14);
    // A single patch that sends half of its power back to itself: that is where the norm is found.
    DenseChannel::Matrix one = DenseChannel::Matrix::Zero(6, 6);
    one(4, 4) = 0.5;
    one(3, 2) = 1e-3;  // of patch 2: 20 · 1e-3 / 0.3 of its power
    EXPECT_EQ(operator_norms(DenseChannel(one, area)).one_at, 4);
    EXPECT_NEAR(operator_norms(DenseChannel(one, area)).one, 0.5, 1e-15);
}

TEST(Spectra, ComplexPairs) {
    // 40 turning pairs with moduli 0.9, 0.8, 0.79, …: 0.9 e^{±iπ/5} leads.
    DenseChannel::Matrix K = DenseChannel::Matrix::Zero(80, 80);
    for (int k = 0; k < 40; ++k) {
        const double modulus = k == 0 ? 0.9 : 0.81 - 0.01 * k, angle = std::numbers::pi / 5;
        K.block<2, 2>(2 * k, 2 * k) << modulus * std::cos(angle), -modulus * std::sin(angle), modulus * std::sin(angle),
            modulus * std::cos(angle);
    }
    const Eigenpairs found = leading_eigenpairs(DenseChannel(K, Vector::Ones(80)), 2);
    ASSERT_TRUE(found.converged);
    EXPECT_NEAR(std::abs(found.pairs[0].value), 0.9, 1e-10);
    EXPECT_NEAR(std::abs(found.pairs[0].value.imag()), 0.9 * std::sin(std::numbers::pi / 5), 1e-10);
    EXPECT_LT(found.pairs[0].residual, 1e-9);
}

// A search that ends early says so, with what it reached: as far from K v = λ v as it says.
TEST(Spectra, WhatIsNotFoundIsSaid) {
    const Eigen::Index n = 400;
    DenseChannel::Matrix matrix = DenseChannel::Matrix::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
        matrix(i, i) = 1.0 - 1e-4 * static_cast<double>(i);
        matrix(i, (i + 7) % n) = 1e-3;
    }
    const DenseChannel K(matrix, Vector::Ones(n));
    std::size_t asked = 0;
    EigenLimits few, stopped;
    few.most = 50.0;
    stopped.most = 1e9;
    stopped.watch.stop = [&] { return ++asked > 77; };
    for (const EigenLimits* limits : {&few, &stopped}) {
        const Eigenpairs found = leading_eigenpairs(K, 4, false, *limits);
        EXPECT_FALSE(found.converged);
        EXPECT_TRUE(std::isnan(found.radius()));
        ASSERT_EQ(found.pairs.size(), 4u);
        for (const Eigenpair& pair : found.pairs) {
            EXPECT_NEAR(pair.vector.norm(), 1.0, 1e-12);
            EXPECT_NEAR((matrix * pair.vector - pair.value * pair.vector).norm(), pair.residual, 1e-12);
            EXPECT_GT(pair.residual, 1e-8);
        }
        ASSERT_FALSE(found.history.empty());
        EXPECT_TRUE(found.why.starts_with(fmt::format("not found within {:.0f} applications of K, largest residual {:.1e}",
                                                      found.applications, found.history.back().residual)))
            << found.why;
    }
    EXPECT_EQ(leading_eigenpairs(K, 4, false, few).applications, 50.0);
    EXPECT_TRUE(leading_eigenpairs(K, 4).converged);
    EXPECT_TRUE(std::isnan(operator_norms(K, few).two));
}

// Light that goes round in cycles of 2, 3, 5, … for good, of which 1 − 0.7 is lost each time: many eigenvalues of modulus 0.7, and
// no search from one start settles. The others lose more, and some of what they keep gets into the cycles.
TEST(Spectra, TheRadiusOfWhatIsKeptForGood) {
    const int lengths[] = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37};
    const Eigen::Index n = 197 + 100;
    DenseChannel::Matrix matrix = DenseChannel::Matrix::Zero(n, n);
    Eigen::Index first = 0;
    for (const int length : lengths) {
        for (Eigen::Index i = 0; i < length; ++i) matrix(first + i, first + (i + 1) % length) = 0.7;
        first += length;
    }
    ASSERT_EQ(first, 197);
    for (Eigen::Index i = first; i < n; ++i) {
        matrix(i, i % first) = 0.3;
        matrix(i, i) = 0.3;
    }
    const DenseChannel K(matrix, Vector::Ones(n));
    const RadiusBounds bounds = radius_bounds(K, 200.0);
    EXPECT_TRUE(bounds.meet());
    EXPECT_NEAR(bounds.low, 0.7, 1e-12);
    EXPECT_NEAR(bounds.high, 0.7, 1e-10);
    const Eigenpairs found = leading_eigenpairs(K, 4);
    EXPECT_FALSE(found.converged);
    EXPECT_TRUE(found.why.ends_with(": it falls too slowly for 10000")) << found.why;
    EXPECT_LT(found.applications, 6000.0);
    // Where nothing is kept for good they are bounds, and need not meet: the cube
    const Cube cube = symmetric_cube(4);
    const DenseChannel some = cube.channel(0.5);
    const RadiusBounds wide = radius_bounds(some, 20.0);
    EXPECT_LE(wide.low, spectral_radius(some) * (1.0 + 1e-12));
    EXPECT_GE(wide.high, spectral_radius(some) * (1.0 - 1e-12));
    const RadiusBounds dark = radius_bounds(DenseChannel(DenseChannel::Matrix::Zero(3, 3), Vector::Ones(3)), 20.0);
    EXPECT_EQ(dark.high, 0.0);
}

// The integrating sphere, K = ρ aᵀ, has one eigenvalue that is not 0, its trace. Spaces close after two steps; so do those of
// several spheres that do not see each other, after one step more than there are. ‖ρ aᵀ‖₂ = ‖ρ‖ ‖a‖.
TEST(Spectra, SpacesThatCloseEarly) {
    for (int seed = 0; seed < 200; ++seed) {
        std::mt19937_64 bits(static_cast<std::uint64_t>(seed));
        std::uniform_real_distribution<double> uniform;
        const Eigen::Index spheres = 1 + seed % 5, each = 80 + seed % 7;
        DenseChannel::Matrix matrix = DenseChannel::Matrix::Zero(spheres * each, spheres * each);
        std::vector<double> traces;
        double two = 0.0;
        for (Eigen::Index s = 0; s < spheres; ++s) {
            const Vector rho = Vector::NullaryExpr(each, [&] { return uniform(bits); }),
                         a = Vector::NullaryExpr(each, [&] { return uniform(bits); }) / static_cast<double>(each);
            matrix.block(s * each, s * each, each, each) = rho * a.transpose();
            traces.push_back(rho.dot(a));
            two = std::max(two, rho.norm() * a.norm());
        }
        std::ranges::sort(traces, std::greater());
        for (const int power : {0, -150, 160}) {
            const double scale = std::pow(10.0, power);
            const DenseChannel K(scale * matrix, Vector::Ones(matrix.rows()));
            for (const int count : {1, static_cast<int>(spheres) + 3}) {
                const Eigenpairs found = leading_eigenpairs(K, count);
                ASSERT_TRUE(found.converged) << seed << ": " << found.why;
                ASSERT_EQ(found.pairs.size(), static_cast<std::size_t>(count));
                for (std::size_t i = 0; i < found.pairs.size(); ++i) {
                    const Eigenpair& pair = found.pairs[i];
                    const double right = i < traces.size() ? traces[i] : 0.0;
                    EXPECT_LE(std::abs(pair.value / scale - right), 1e-12) << seed << ", eigenvalue " << i + 1;
                    EXPECT_LE((K.matrix() / scale * pair.vector - pair.value / scale * pair.vector).norm(), 1e-12) << seed;
                    EXPECT_NEAR(pair.vector.norm(), 1.0, 1e-12);
                }
            }
            EXPECT_NEAR(operator_norms(K).two / scale, two, 1e-9) << seed;
        }
    }
}

// K^m = 0, with the unknowns in any order: light ends after m bounces, all eigenvalues are 0 and not the m-th root of a rounding
// error. On few unknowns, too, of which the matrix is formed.
TEST(Spectra, LightThatEndsHasNoEigenvalueButZero) {
    for (const Eigen::Index n : {1, 20, 65, 200})
        for (const Eigen::Index layers : {1, 2, 3, 12}) {
            std::mt19937_64 bits(static_cast<std::uint64_t>(100 * n + layers));
            std::uniform_real_distribution<double> uniform;
            std::vector<Eigen::Index> layer(static_cast<std::size_t>(n));
            for (Eigen::Index& l : layer) l = static_cast<Eigen::Index>(bits() % static_cast<std::uint64_t>(layers));
            DenseChannel::Matrix matrix(n, n);
            for (Eigen::Index u = 0; u < n; ++u)
                for (Eigen::Index v = 0; v < n; ++v)
                    matrix(u, v) = layer[static_cast<std::size_t>(u)] > layer[static_cast<std::size_t>(v)] ? uniform(bits) : 0.0;
            for (const double scale : {1.0, 1e-150, 1e160}) {
                const DenseChannel K(scale * matrix, Vector::Ones(n));
                for (const bool adjoint : {false, true}) {
                    const Eigenpairs found = leading_eigenpairs(K, 4, adjoint);
                    EXPECT_TRUE(found.converged) << n << ", " << layers << ": " << found.why;
                    EXPECT_EQ(found.radius(), 0.0);
                    EXPECT_EQ(found.pairs.size(), static_cast<std::size_t>(std::min<Eigen::Index>(n, 4)));
                    for (const Eigenpair& pair : found.pairs) {
                        EXPECT_EQ(pair.value, 0.0);
                        EXPECT_EQ(pair.residual, 0.0);
                        EXPECT_NEAR(pair.vector.norm(), 1.0, 1e-12);
                    }
                }
                const double two = Eigen::JacobiSVD<Eigen::MatrixXd>(matrix).singularValues()[0];
                EXPECT_NEAR(operator_norms(K).two / scale, two, 1e-12 * two);
            }
        }
}

// Light that ends, beside light that does not: a chain of mirrors into a room of 100 unknowns with λ = 0.8, and out of it again.
TEST(Spectra, SomeLightEnds) {
    const Eigen::Index chain = 30, room = 100;
    DenseChannel::Matrix matrix = DenseChannel::Matrix::Zero(2 * chain + room, 2 * chain + room);
    matrix.block(chain, chain, room, room).setConstant(0.8 / static_cast<double>(room));
    for (Eigen::Index u = 0; u < chain; ++u) matrix(u + 1, u) = matrix(chain + room + u, chain + room + u - 1) = 1.0;
    const Eigenpairs found = leading_eigenpairs(DenseChannel(matrix, Vector::Ones(matrix.rows())), 1);
    EXPECT_TRUE(found.converged) << found.why;
    EXPECT_NEAR(found.radius(), 0.8, 1e-10);
}

// A K that is sampled anew each time it is applied: what a search takes for converged is none.
TEST(Spectra, ASearchIsNotTakenAtItsWord) {
    class Noisy : public DenseChannel {
    public:
        using DenseChannel::DenseChannel;
        void apply(const Vector& x, Vector& y) const override {
            DenseChannel::apply(x, y);
            for (double& value : y) value *= 1.0 + 1e-6 * (static_cast<double>(bits_() >> 11) * 0x1p-52 - 1.0);
        }

    private:
        mutable std::mt19937_64 bits_{1};
    };
    const Cube cube = patched_cube(4);
    const Noisy K(cube.channel(0.9).matrix(), Vector::Ones(cube.size()));
    const Eigenpairs found = leading_eigenpairs(K, 1);
    EXPECT_FALSE(found.converged);
    EXPECT_TRUE(std::isnan(found.radius()));
    ASSERT_EQ(found.pairs.size(), 1u);
    EXPECT_GT(found.pairs[0].residual, 1e-8);
    EXPECT_EQ(found.why, fmt::format("not found within {:.0f} applications of K, largest residual {:.1e}: K does not keep the "
                                     "vectors that the search ended with",
                                     found.applications, found.pairs[0].residual / std::abs(found.pairs[0].value)));
}

TEST(Spectra, ValuesThatAreNotFinite) {
    DenseChannel::Matrix matrix = DenseChannel::Matrix::Constant(100, 100, 0.005);
    matrix(7, 3) = std::numeric_limits<double>::quiet_NaN();
    for (const Eigen::Index n : {20, 100}) {
        const DenseChannel K(matrix.topLeftCorner(n, n), Vector::Ones(n));
        const Eigenpairs found = leading_eigenpairs(K, 2);
        EXPECT_FALSE(found.converged);
        EXPECT_TRUE(std::isnan(found.radius()));
        EXPECT_TRUE(found.why.ends_with("too few to say more: K has values that are not finite")) << found.why;
        EXPECT_TRUE(std::isnan(operator_norms(K).two));
    }
}

TEST(Spectra, DefectsAreSeen) {
    // One entry of a reciprocal F off by 1%.
    DenseChannel::Matrix F = DenseChannel::Matrix::Constant(3, 3, 1.0 / 3);
    EXPECT_LT(reciprocity_defect(DenseChannel(F, Vector::Ones(3))), 1e-15);
    F(0, 1) *= 1.01;
    EXPECT_NEAR(closure_defect(DenseChannel(F, Vector::Ones(3))), 0.01 / 3, 1e-15);
    EXPECT_GT(reciprocity_defect(DenseChannel(F, Vector::Ones(3))), 1e-4);
    EXPECT_LT(adjoint_defect(DenseChannel(F, Vector::Ones(3))), 1e-15);
}

// A scalar furnace in float: where S_n stops changing, 138, 1241, 10392 with terms multiplied in float. Terms in double may move it
// by a few. The estimate is within 10%.
TEST(Spectra, WhereSumsStagnate) {
    const std::pair<double, int> rows[] = {{0.9, 138}, {0.99, 1241}, {0.999, 10392}};
    for (const auto& [rho, bounce] : rows) {
        const DenseChannel K(DenseChannel::Matrix::Constant(1, 1, rho), Vector::Ones(1));
        const auto found = stagnation<float>(K, Vector::Ones(1), 20000);
        ASSERT_TRUE(found.has_value());
        EXPECT_NEAR(*found, bounce, 0.01 * bounce);
        EXPECT_NEAR(expected_stagnation(std::numeric_limits<float>::epsilon(), rho), bounce, 0.1 * bounce);
    }
    // The cube with 16 × 16 patches a face: 140 and 1201.
    const Cube cube = symmetric_cube(16);
    EXPECT_NEAR(*stagnation<float>(cube.channel(0.9), cube.ceiling(), 2000), 140, 2);
    EXPECT_NEAR(*stagnation<float>(cube.channel(0.99), cube.ceiling(), 2000), 1201, 12);
    // In double: ρ^n < 2^-53 / (1 − ρ), n = 326 at 0.9.
    EXPECT_NEAR(*stagnation<double>(cube.channel(0.9), cube.ceiling(), 2000), 326, 10);
    EXPECT_FALSE(stagnation<double>(cube.channel(0.9), cube.ceiling(), 100).has_value());
}

// What rounding ρ itself does to the furnace: 1/(1 − float(ρ)) against 1/(1 − ρ) stays below the floor, and is of its size.
TEST(Spectra, RoundingFloor) {
    const std::pair<double, double> rows[] = {{0.9, 2.4e-7}, {0.99, 9.5e-7}, {0.999, 1.3e-5}, {0.9999, 1.7e-4}, {0.999999, 1.3e-2}};
    for (const auto& [rho, change] : rows) {
        const double rounded = static_cast<double>(static_cast<float>(rho));
        const double found = std::abs((1 - rho) / (1 - rounded) - 1);
        EXPECT_NEAR(found, change, 0.05 * change);
        EXPECT_LE(found, 1.02 * rounding_floor(std::numeric_limits<float>::epsilon(), rho));
    }
}

}  // namespace neumann::spectra_test
