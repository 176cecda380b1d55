// Walks that go on by points on all surfaces, and walks that go on in mirrors alone.
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

namespace neumann::physics::continuations_test {

// A floor, a wall, a slanted metal plate and a lamp that nowhere touch: the variances of all ways are finite.
SceneMaker plates() {
    SceneMaker maker;
    maker.add(parallelogram({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), matte(0.7));
    maker.add(parallelogram({-1.5, -1, 0.5}, {0, 2, 0}, {0, 0, 1}), matte(0.5));
    maker.add(parallelogram({1.3, -0.7, 0.4}, {0, 0, 1}, {0.4, 1.4, 0}),
              made_of(RoughConductor<Ggx>(Ggx(0.5), ConductorFresnel{}, grey(0.8))));
    maker.add(parallelogram({-0.5, -0.5, 2}, {0, 1, 0}, {1, 0, 0}), lamp(4.0));
    return maker;
}
constexpr std::uint32_t plates_floor = 0;

void expect_agreement(const Estimates& a, const Estimates& b, std::size_t last, double visible) {
    for (std::size_t i = 1; i <= last; ++i) {
        const double error = std::hypot(a.terms[i].standard_error.r, b.terms[i].standard_error.r);
        EXPECT_NEAR(a.terms[i].mean.r, b.terms[i].mean.r, 4.5 * error) << "bounce " << i;
        EXPECT_LT(error, visible * b.terms[i].mean.r) << "no power in bounce " << i;
    }
}

// In a round furnace the kernel cosθ cosθ' / d² is 1/(4 R²) between any two points, so every weight is ρ, but for rounding.
TEST(Continuations, SurfacesInASphereAreExact) {
    constexpr double rho = 0.7;
    SceneMaker maker;
    maker.add(Sphere{{1, 2, 3}, 2.5, true}, glowing(rho, 1.0));
    const Scene scene = maker.make();
    const Estimates found = probe(scene, at(scene, {1, 2, 5.5}, {0, 0, -1}), Technique::light,
                                  {.samples = 256, .bounces = 6, .going_on = GoingOn::surfaces});
    for (int i = 0; i <= 6; ++i)
        EXPECT_NEAR(found.terms[static_cast<std::size_t>(i)].mean.r, std::pow(rho, i), 1e-10) << "bounce " << i;
}

// Bounces 1 to 3 of diffuse and of metal plates, with lights found by points, by what is hit, and by both, whose weights ask the
// continuation for its density. 9 comparisons.
TEST(ContinuationsSlow, SurfacesAgreeWithTheWalk) {
    const Scene scene = plates().make();
    const StartPicker start = anywhere_on(scene, plates_floor);
    const Estimates plain = probe(scene, start, Technique::mis, {.samples = 16384, .bounces = 3, .seed = fixed_seed + 1});
    for (const DirectLight direct : {DirectLight::light, DirectLight::bsdf, DirectLight::mis})
        expect_agreement(
            probe(scene, start, Technique::mis,
                  {.samples = 32768, .bounces = 3, .direct = DirectLightSettings{.direct = direct}, .going_on = GoingOn::surfaces}),
            plain, 3, direct == DirectLight::bsdf ? 0.05 : 0.02);
}

// The rest, too: walks go on beyond the last picture. 1 comparison.
TEST(ContinuationsSlow, SurfacesHaveARest) {
    const Scene scene = plates().make();
    const StartPicker start = anywhere_on(scene, plates_floor);
    const Estimates plain =
        probe(scene, start, Technique::mis, {.samples = 8192, .bounces = 1, .rest_probability = 1.0, .seed = fixed_seed + 1});
    const Estimates found = probe(scene, start, Technique::light,
                                  {.samples = 16384, .bounces = 1, .rest_probability = 1.0, .going_on = GoingOn::surfaces});
    const double error = std::hypot(found.rest.standard_error.r, plain.rest.standard_error.r);
    EXPECT_NEAR(found.rest.mean.r, plain.rest.mean.r, 4.5 * error);
    EXPECT_LT(error, 0.02 * plain.rest.mean.r);
}

// Where two walls meet, cosθ cosθ'/d² between their points is above w with a probability ~ w^−1.5, so the variance is infinite. In
// a cube that glows all over it is all that varies. The alarm has to say so, and to be silent of the walk, and of plates that do
// not touch.
TEST(ContinuationsSlow, TheAlarmIsRaisedInCorners) {
    SceneMaker maker;
    maker.add(room({0, 0, 0}, {1, 1, 1}), glowing(0.8, 1.0));
    const Scene closed = maker.make(), open = plates().make();
    for (std::uint64_t seed = fixed_seed; seed < fixed_seed + 3; ++seed) {
        const auto tails = [&](const Scene& scene, const StartPicker& start, Technique way, GoingOn going_on) {
            const Estimates found =
                probe(scene, start, way,
                      {.samples = 16384, .bounces = 2, .sampler = SamplerKind::independent, .seed = seed, .going_on = going_on});
            return std::array{tail_index(found.largest[1]), tail_index(found.largest[2])};
        };
        for (const auto& tail : tails(closed, anywhere(closed), Technique::bsdf, GoingOn::surfaces)) {
            ASSERT_TRUE(tail);
            EXPECT_TRUE(tail->variance_is_infinite()) << "tail index " << tail->alpha;
            EXPECT_NEAR(tail->alpha, 1.5, 0.25);
        }
        for (const auto& none : tails(closed, anywhere(closed), Technique::bsdf, GoingOn::material))
            EXPECT_FALSE(none && none->variance_is_infinite()) << none->alpha;
        for (const auto& none : tails(open, anywhere_on(open, plates_floor), Technique::light, GoingOn::surfaces))
            EXPECT_FALSE(none && none->variance_is_infinite()) << none->alpha;
    }
}

// Nothing in a diffuse furnace is specular: bounce 1 asks for its light, and there is no other.
TEST(Continuations, SpecularEndsAtDiffuseSurfaces) {
    SceneMaker maker;
    maker.add(Sphere{{0, 0, 0}, 1.0, true}, glowing(0.7, 1.0));
    const Scene scene = maker.make();
    for (const Technique way : {Technique::light, Technique::mis}) {
        const Estimates found =
            probe(scene, at(scene, {0, 0, 1}, {0, 0, -1}), way, {.samples = 64, .bounces = 3, .going_on = GoingOn::specular});
        EXPECT_NEAR(found.terms[0].mean.r, 1.0, 1e-12);
        EXPECT_NEAR(found.terms[1].mean.r, 0.7, 1e-12) << "lights are all that finds light: they have their whole weight";
        for (const std::size_t i : {2, 3}) EXPECT_EQ(found.terms[i].mean.r, 0.0);
        EXPECT_EQ(found.rays[2], 0.0) << "the walk has ended";
    }
}

// A mirror above a diffuse floor beside a lamp: what the camera sees in the mirror is bounce 2, the same as the walk's, and so is
// bounce 1 on the floor; bounce 2 on the floor, by way of the mirror, is missing. 2 comparisons.
TEST(ContinuationsSlow, SpecularIsTheWalkByWayOfMirrors) {
    SceneMaker maker;
    maker.add(parallelogram({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), matte(0.7));
    const std::uint32_t mirror = maker.add(parallelogram({-1, -1, 2}, {0, 2, 0}, {2, 0, 0}), made_of(Conductor({}, grey(0.9))));
    maker.add(parallelogram({-2, -0.5, 0.5}, {0, 1, 0}, {0, 0, 1}), lamp(4.0));
    const Scene scene = maker.make();
    const auto both = [&](const StartPicker& start) {
        return std::pair(probe(scene, start, Technique::light, {.bounces = 3, .going_on = GoingOn::specular}),
                         probe(scene, start, Technique::light, {.bounces = 3, .seed = fixed_seed + 1}));
    };
    const auto [mirrored, all_mirrored] = both(anywhere_on(scene, mirror));
    const Statistic &a = mirrored.terms[2], &b = all_mirrored.terms[2];
    const double error = std::hypot(a.standard_error.r, b.standard_error.r);
    EXPECT_NEAR(a.mean.r, b.mean.r, 4.5 * error);
    EXPECT_LT(error, 0.01 * b.mean.r);
    EXPECT_EQ(mirrored.terms[3].mean.r, 0.0);
    EXPECT_GT(all_mirrored.terms[3].mean.r, 10.0 * all_mirrored.terms[3].standard_error.r);
    const auto [floor, all_floor] = both(anywhere_on(scene, 0));
    expect_agreement(floor, all_floor, 1, 0.01);
    EXPECT_EQ(floor.terms[2].mean.r, 0.0);
    EXPECT_GT(all_floor.terms[2].mean.r, 10.0 * all_floor.terms[2].standard_error.r);
}

}  // namespace neumann::physics::continuations_test
