// How eigenvalues and norms are found, and what is said where they are not. Known spectra are in operators/known/eigenvalues.cpp.
#include "operators/known/cube.h"
#include "operators/known/small_problems.h"
#include "operators/spectrum/closure.h"
#include "operators/spectrum/radius_bounds.h"
#include "operators/spectrum/rounding_floor.h"
#include "operators/spectrum/spectrum.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

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
