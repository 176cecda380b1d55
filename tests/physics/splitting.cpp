// Several questions for light, and several walks, from the first vertex of each camera ray: means as ever, variances divided.
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace neumann::physics::splitting_test {

constexpr Split splits[] = {{8, 8}, {1, 16}, {16, 1}, {3, 5}};
std::string describe(const Split& s) { return fmt::format("split {},{}", s.lights, s.walks); }

// Below the ceiling of a unit cube, all of it a lamp, as in direct_strategies.cpp: questions and directions are independent, so the
// variance of one is divided by their number. 8 comparisons.
TEST(SplittingSlow, VariancesAreDivided) {
    SceneMaker maker;
    maker.add(patch({0.5, 0.5, 0}, {0, 0, 1}, 0.01), matte(1.0));
    maker.add(parallelogram({0, 0, 1}, {0, 1, 0}, {1, 0, 0}), lamp(1.0));
    const Scene scene = maker.make();
    for (const Split& split : splits) {
        SCOPED_TRACE(describe(split));
        const auto variance = [&](DirectLight direct) {
            return probe(scene, at(scene, {0.5, 0.5, 0}, {0, 0, 1}), Technique::mis,
                         {.samples = 1 << 11,
                          .bounces = 1,
                          .sampler = SamplerKind::independent,
                          .direct = DirectLightSettings{.direct = direct},
                          .split = split})
                .variance[1];
        };
        expect_matches(variance(DirectLight::light), 0.00174051 / split.lights, "variance of points on the light", 0.005);
        expect_matches(variance(DirectLight::bsdf), 0.18211707 / split.walks, "variance of directions", 0.005);
    }
}

// In a furnace every sample is the same: rays are C a bounce, those of the questions, which all see light, L more in the first and
// C more in each further one.
TEST(Splitting, RaysAreCounted) {
    constexpr double rho = 0.7;
    SceneMaker maker;
    maker.add(Sphere{{0, 0, 0}, 1.0, true}, glowing(rho, 1.0));
    const Scene scene = maker.make();
    for (const Split& split : splits)
        for (const Technique way : {Technique::bsdf, Technique::light}) {
            SCOPED_TRACE(describe(split) + ", " + name(way));
            const Estimates found =
                probe(scene, at(scene, {0, 0, 1}, {0, 0, -1}), way, {.samples = 64, .bounces = 3, .split = split});
            for (int i = 0; i <= 3; ++i)
                EXPECT_NEAR(found.terms[static_cast<std::size_t>(i)].mean.r, std::pow(rho, i), 1e-12) << "bounce " << i;
            const double samples_lights = way == Technique::light ? 1.0 : 0.0;
            EXPECT_EQ(found.rays[0], 1.0);
            EXPECT_EQ(found.rays[1], split.walks + samples_lights * split.lights);
            EXPECT_EQ(found.rays[2], split.walks * (1.0 + samples_lights));
            EXPECT_EQ(found.rays[3], split.walks * 1.0) << "the last bounce wants one of the two";
        }
}

// Bounces 1 to 3 and the rest in a room, whichever way lights are found, against single walks. 4 × 4 × 4 = 64 comparisons.
TEST(SplittingSlow, MeansAreThoseOfSingleWalks) {
    SceneMaker maker;
    maker.add(room({-1, -1, 0}, {1, 1, 1.6}), matte(0.6));
    maker.add(strips({-0.5, -0.5, 1.5}, {0, 0.5, 0}, {0.5, 0, 0}, 3), lamp(5.0));
    maker.add(Sphere{{0.4, 0.3, 0.4}, 0.2, false}, glowing(0.3, 0.5));
    const Scene scene = maker.make();
    const StartPicker start = anywhere_on(scene, static_cast<std::uint32_t>(floor));
    const Estimates plain =
        probe(scene, start, Technique::mis, {.samples = 8192, .bounces = 3, .rest_probability = 1.0, .seed = fixed_seed + 1});
    for (const DirectLightSettings& direct :
         {DirectLightSettings{}, DirectLightSettings{.heuristic = Heuristic::balance},
          DirectLightSettings{.lights = LightChoice::all}, DirectLightSettings{.direct = DirectLight::cosine}})
        for (const Split& split : splits) {
            SCOPED_TRACE(describe(split) +
                         fmt::format(", direct {}, lights {}", static_cast<int>(direct.direct), static_cast<int>(direct.lights)));
            const Estimates found = probe(scene, start, Technique::mis,
                                          {.samples = direct.direct == DirectLight::cosine ? 4096u : 256u,
                                           .bounces = 3,
                                           .rest_probability = 1.0,
                                           .direct = direct,
                                           .roulette = {Roulette::Kind::throughput},
                                           .split = split});
            for (std::size_t i = 1; i <= 4; ++i) {
                const Statistic &a = i < 4 ? found.terms[i] : found.rest, &b = i < 4 ? plain.terms[i] : plain.rest;
                const double error = std::hypot(a.standard_error.r, b.standard_error.r);
                EXPECT_NEAR(a.mean.r, b.mean.r, 4.5 * error) << "bounce " << i;
                EXPECT_LT(error, 0.03 * b.mean.r) << "no power in bounce " << i;
            }
        }
}

}  // namespace neumann::physics::splitting_test
