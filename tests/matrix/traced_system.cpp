// A scene as matrices for the commands: channels, b, coarser spectra, and what they say of the series.
#include "operators/fields/matrix/traced_system.h"

#include "core/base/error.h"
#include "operators/fields/matrix/channel_choice.h"
#include "operators/fields/matrix/refinement.h"
#include "operators/solvers/remaining.h"
#include "operators/solvers/spectrum/convergence.h"
#include "operators/solvers/spectrum/spectrum.h"
#include "tests/physics/scene_maker.h"
#include "tests/physics/seed.h"

#include <gtest/gtest.h>
#include <cstdio>
#include <limits>

namespace neumann::traced_system_test {

using namespace physics;

Scene furnace(const Rgb& rho) {
    SceneMaker maker;
    maker.add(room({-1, -1, -1}, {1, 1, 1}), Surface{rho, AreaLight(Rgb(1.0)), false});
    return maker.make();
}

TEST(TracedSystem, FurnaceChannels) {
    const Scene scene = furnace(Rgb(0.25, 0.5, 0.75));
    const TracedSystem system(scene, {200, 16, 0});
    ASSERT_EQ(system.channels(), 3);
    EXPECT_FALSE(system.samples_lights());
    EXPECT_EQ(system.rays_that_see_nothing(), 0u);
    EXPECT_EQ(system.rays(), 16u * system.space().size());
    for (int c = 0; c < 3; ++c) {
        const Vector expected = Vector::Constant(system.space().size(), 0.25 * (c + 1));
        EXPECT_EQ(system.channel(c).reflectance(), expected);
        EXPECT_EQ(system.direct(c), expected);
        EXPECT_EQ(system.emitted(c), Vector::Ones(system.space().size()));
        EXPECT_EQ(system.largest_albedo(c), 0.25 * (c + 1));
    }
    EXPECT_EQ(most_reflecting_channel(system), 2);  // ⟨K 1, 1⟩ / ⟨1, 1⟩ is the albedo
    EXPECT_EQ(TracedSystem(furnace(Rgb(0.5)), {200, 16, 0}).channels(), 1);
}

// In a furnace (K* 1)_u = ρ for every unknown, by reciprocity; traced, it is a sum over the rays that happen to meet u, whose
// square of the standard error has the variance for its mean, were the rays not stratified. So of the power that is off by, squared
// and added up over patches from 1 : 1 to 1 : 300 in area, the errors tell all or too much: over 40 seeds 0.63 to 0.94 of it.
TEST(TracedSystem, PowerThatABounceLeavesHasAnError) {
    SceneMaker maker;
    const Rgb rho(0.5);
    const auto faces = room({-1, -1, -1}, {1, 1, 1});
    for (std::size_t i = 0; i < 6; ++i)
        if (i != floor) maker.add(faces[i], Surface{rho, AreaLight(Rgb(1.0)), false});
    maker.add(strips({-1, -1, -1}, {0.2, 0, 0}, {0, 2, 0}, 10), Surface{rho, AreaLight(Rgb(1.0)), false});
    maker.add(parallelogram({-0.8, -1, -1}, {1.8, 0, 0}, {0, 2, 0}), Surface{rho, AreaLight(Rgb(1.0)), false});
    const Scene scene = maker.make();
    const TracedSystem system(scene, {400, 64, fixed_seed});
    const TracedChannel K = system.channel(0);
    Vector left(K.size());
    K.apply_adjoint(Vector::Ones(K.size()), left);
    double squares = 0.0, expected = 0.0;
    for (Eigen::Index u = 0; u < K.size(); ++u) {
        squares += std::pow(K.measure()[u] * (left[u] - 0.5), 2);
        expected += std::pow(K.measure()[u] * K.standard_error_of_power(u), 2);
    }
    std::printf("patches: (power - rho)^2 is %.3f of its error's\n", squares / expected);
    EXPECT_GT(squares, 0.4 * expected);
    EXPECT_LT(squares, 1.2 * expected);
    const OperatorNorms norms = operator_norms(K);
    EXPECT_EQ(norms.one, left[norms.one_at]);
    EXPECT_EQ(norms.one, left.maxCoeff());
}

// A light of a hundredth of the room's area is met by hardly a ray of each patch; its power is found all the same.
TEST(TracedSystem, SamplesLightsThatRaysHardlyMeet) {
    SceneMaker maker;
    maker.add(room({-1, -1, -1}, {1, 1, 1}), matte(0.5));
    maker.add(parallelogram({-0.25, -0.25, 0.99}, {0, 0.5, 0}, {0.5, 0, 0}), glowing(0.5, 1.0));
    const Scene scene = maker.make();
    const TracedSystem system(scene, {400, 64, 0});
    ASSERT_TRUE(system.samples_lights());
    const TracedChannel K = system.channel(0);
    const Vector Le = system.emitted(0), b = system.direct(0);
    // All that the light sends meets a wall, which sends half of it on: 0.25 π · 1/2. Up to the noise of 64 points a patch.
    EXPECT_NEAR(K.measure().dot(Le), 0.25 * pi, 1e-12);
    EXPECT_NEAR(K.measure().dot(b), 0.125 * pi, 0.01 * 0.125 * pi);
}

TEST(TracedSystem, RefusesWhatDoesNotFit) {
    const Scene scene = furnace(Rgb(0.5));
    EXPECT_THROW(TracedSystem(scene, {std::size_t{1} << 40, 64, 0}), InputError);
    EXPECT_THROW(TracedSystem(scene, {1000000, 1u << 31, 0}), InputError);
    EXPECT_THROW(TracedSystem(SceneMaker().make(), {100, 16, 0}), InputError);
}

TEST(Refinement, FurnaceDoesNotMove) {
    const Scene scene = furnace(Rgb(0.9));
    const auto rows = coarser_spectra(TracedSystem(scene, {160, 16, 0}));
    ASSERT_EQ(rows.size(), 4u);
    for (const RefinementRow& row : rows) EXPECT_NEAR(std::abs(row.leading[0][0]), 0.9, 1e-12);
    EXPECT_LE(radius_shift(rows, 0, 0.9), 1e-12);
    EXPECT_NEAR(radius_shift(rows, 0, 0.95), 0.05, 1e-12);
    EXPECT_EQ(coarser_spectra(TracedSystem(scene, {8, 8, 0})).size(), 2u);
    EXPECT_TRUE(std::isnan(radius_shift({}, 0, 0.9)));
}

TEST(ConvergenceJudge, Radius) {
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(judge(0.99, 0.001), Convergence::converges);
    EXPECT_EQ(judge(0.9999, 0.001), Convergence::undecided);
    EXPECT_EQ(judge(1.0001, 0.001), Convergence::undecided);
    EXPECT_EQ(judge(1.01, 0.001), Convergence::diverges);
    EXPECT_EQ(judge(1.0 - 1e-14, 0.0), Convergence::at_one);
    EXPECT_EQ(judge(0.99, unknown), Convergence::converges);
    EXPECT_EQ(judge(unknown, 0.0), Convergence::undecided);
}

// After n bounces ρ^(n+1) of the power is left.
TEST(PowerRows, Furnace) {
    for (const double rho : {0.25, 0.9, 0.99}) {
        const Scene scene = furnace(Rgb(rho));
        const TracedSystem system(scene, {24, 16, 0});
        const auto rows = power_rows(system.channel(0), system.emitted(0), system.direct(0), 1e-9, 100000);
        for (const double part : {0.1, 0.01, 0.001})
            EXPECT_EQ(bounces_until(rows, part), static_cast<int>(std::ceil(std::log(part) / std::log(rho) - 1.0))) << rho;
    }
    const Scene white = furnace(Rgb(1.0));
    const TracedSystem system(white, {24, 16, 0});
    const auto rows = power_rows(system.channel(0), system.emitted(0), system.direct(0), 1e-9, 100000);
    EXPECT_LE(rows.size(), 40u);
    EXPECT_EQ(bounces_until(rows, 0.1), std::nullopt);
}

}  // namespace neumann::traced_system_test
