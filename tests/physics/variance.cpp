// The variance of one sample is known exactly for some estimators, and is known to be infinite for others. All samples are
// independent here.
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

namespace neumann::physics {
namespace {

// The unit cube with ρ = 1 and an emitting ceiling, at the floor's centre: K^i Le = g_i.
constexpr double g1 = 0.23945647046077306, g2 = 0.13875246294508298;

Scene cube() {
    SceneMaker maker;
    const auto faces = room({0, 0, 0}, {1, 1, 1});
    for (std::size_t i = 0; i < 6; ++i) maker.add(faces[i], i == ceiling ? glowing(1.0, 1.0) : matte(1.0));
    return maker.make();
}
Estimates at_floor_center(Way way, std::uint32_t samples, int bounces = 2, std::uint64_t seed = fixed_seed) {
    const Scene scene = cube();
    return probe(scene, at(scene, {0.5, 0.5, 0}, {0, 0, 1}), way,
                 {.samples = samples, .bounces = bounces, .sampler = SamplerKind::independent, .seed = seed});
}

// A walk finds the light or does not, so the variance is g (1 − g): 0.18211707 for K^1, 0.11950022 for K^2. Points on the light:
// 0.00174051, by quadrature. 5 comparisons.
TEST(Variance, OfASampleOfDirectLight) {
    const Estimates by_walk = at_floor_center(Way::bsdf, 16384);
    expect_matches(by_walk.variance[1], g1 * (1.0 - g1), "variance of K^1 Le by BSDF sampling");
    expect_matches(by_walk.variance[2], g2 * (1.0 - g2), "variance of K^2 Le by BSDF sampling");
    expect_matches(by_walk.terms[1], g1, "K^1 Le", 0.003);
    const Estimates by_light = at_floor_center(Way::light, 16384);
    expect_matches(by_light.variance[1], 0.0017405096111192883, "variance of K^1 Le by light sampling");
    expect_matches(by_light.terms[1], g1, "K^1 Le");
}

// The operator form asks for K^1 with one direction as well. 1 comparison.
TEST(Variance, OfTheOperatorsIsThatOfTheWalk) {
    expect_matches(at_floor_center(Way::pointwise, 16384, 1).variance[1], g1 * (1.0 - g1), "variance of K^1 Le");
}

// The ceiling touches the walls: for a point on a wall, d below the ceiling, the variance of light sampling is 1/(24 π d²), and
// over all points the samples have P(X > x) ~ x^−1.5, so from K^2 on the variance is infinite. The alarm has to say so, and to be
// silent where the variance is finite.
TEST(VarianceSlow, TheAlarmIsRaisedForALightThatTouchesAWall) {
    for (std::uint64_t seed = fixed_seed; seed < fixed_seed + 3; ++seed) {
        const auto tail = tail_index(at_floor_center(Way::light, 16384, 2, seed).largest[2]);
        ASSERT_TRUE(tail);
        EXPECT_TRUE(tail->variance_is_infinite()) << "tail index " << tail->alpha;
        EXPECT_NEAR(tail->alpha, 1.5, 0.25);
        for (const Way way : {Way::mis, Way::bsdf})
            for (const std::size_t bounce : {1, 2}) {
                const auto none = tail_index(at_floor_center(way, 16384, 2, seed).largest[bounce]);
                EXPECT_FALSE(none && none->variance_is_infinite())
                    << name(way) << ", K^" << bounce << ", tail index " << none->alpha;
            }
        const auto direct = tail_index(at_floor_center(Way::light, 16384, 1, seed).largest[1]);
        EXPECT_FALSE(direct && direct->variance_is_infinite());
    }
}

// Roulette ends a walk in the furnace with probability 1 − ρ at every vertex: 1/(1 − ρ) vertices on average, the first one
// included, one ray each, and the rest, which counts the further vertices, has the variance ρ/(1 − ρ)² of a geometric distribution.
// To 0.4%, the variance to 1.5%: 9 comparisons.
TEST(Variance, RouletteMakesWalksAsLongAsTheAlbedoSays) {
    for (const double rho : {0.5, 0.9, 0.99}) {
        SceneMaker maker;
        maker.add(Sphere{{0, 0, 0}, 1.0, true}, glowing(rho, 1.0));
        const Scene scene = maker.make();
        const Estimates found = probe(
            scene, at(scene, {0, 0, -1}, {0, 0, 1}), Way::bsdf,
            {.samples = rho > 0.95 ? 2048u : 8192u, .bounces = 0, .rest_probability = 1.0, .sampler = SamplerKind::independent});
        expect_matches({Rgb(found.rays_mean), Rgb(found.rays_error)}, 1.0 / (1.0 - rho), "rays of a walk", 0.004);
        expect_matches(found.rest, rho / (1.0 - rho), "rest", 0.004);
        expect_matches(found.rest_variance, rho / std::pow(1.0 - rho, 2), "variance of the rest", 0.015);
    }
}

}  // namespace
}  // namespace neumann::physics
