// What a firefly's path says may help against it: a lamp that is found by chance behind glass is found from its own end,
// where the path has a place to be joined; one that could have been asked for is to be asked for.
#include "operators/render/from_paths/splat_sampler.h"
#include "operators/render/report/remedy.h"
#include "operators/render/report/replay.h"
#include "tests/physics/paths_of.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neumann::remedies_test {

using namespace physics;

constexpr int bounces = 4, size = 8;

// A floor of this material under a pane, above which a lamp shines down; the camera looks at the floor from below the pane.
Scene under_glass(const Surface& ground, bool with_pane) {
    SceneMaker maker;
    maker.add(parallelogram({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), ground);
    if (with_pane) maker.add(parallelogram({-1, -1, 1}, {2, 0, 0}, {0, 2, 0}), boundary(ThinDielectric(1.5), ThinDielectric(1.5)));
    maker.add(parallelogram({-0.2, -0.2, 2}, {0, 0.4, 0}, {0.4, 0, 0}), lamp(1000.0));
    maker.parts.film = {.width = 16, .height = 16, .crop_width = 16, .crop_height = 16, .filter = BoxFilter()};
    maker.parts.camera = {
        .to_world = Mat4({-1, 0, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 0}, {0, -0.9, 0.4, 1}), .fov = 1.0, .near_clip = 1e-3};
    return maker.make();
}

// Of the sample with the largest part of this quantity, among some of all pixels.
std::vector<Remedy> remedies_of_largest(const Scene& scene, const SamplingSettings& settings, std::size_t quantity) {
    const PictureSampler sampler(scene, settings);
    SampleName name;
    double most = 0.0;
    for (std::uint32_t pixel = 0; pixel < 256; ++pixel)
        for (std::uint64_t i = 0; i < size; ++i) {
            const double value = max_component(replay(sampler, {pixel, i}).terms[quantity]);
            if (value > most) name = {pixel, i};
            most = std::max(most, value);
        }
    EXPECT_GT(most, 1.0) << "nothing was found";
    return remedies(scene, sampler, name, quantity);
}

SamplingSettings settings(const std::shared_ptr<const PathMethod>& method, DirectLight direct = DirectLight::mis) {
    return {.method = method, .walk = {.bounces = bounces, .direct = {direct}}, .seed = 3, .replicate_size = size};
}

using Remedies = std::vector<Remedy>;

TEST(Remedies, ALampBehindGlassIsFoundFromItsOwnEnd) {
    const Scene scene = under_glass(matte(0.8), true);
    EXPECT_EQ(remedies_of_largest(scene, settings(plain_walks()), 2), Remedies{Remedy::bidirectional});
    EXPECT_EQ(remedies_of_largest(scene, settings(plain_walks(), DirectLight::bsdf), 2), Remedies{Remedy::bidirectional});
    EXPECT_EQ(remedies_of_largest(scene, {.walk = {.bounces = 1}, .seed = 3, .replicate_size = size}, 2),
              (Remedies{Remedy::bidirectional, Remedy::more_bounces}));
}

TEST(Remedies, ALampThatIsSeenIsAskedFor) {
    const Scene scene = under_glass(matte(0.8), false);
    EXPECT_EQ(remedies_of_largest(scene, settings(plain_walks(), DirectLight::bsdf), 1), Remedies{Remedy::sample_lights});
}

// The floor is a mirror: every vertex is a delta, and nothing can be joined.
TEST(Remedies, NothingHelpsWhereNothingCanBeJoined) {
    const Scene scene = under_glass(made_of(Conductor({}, Rgb(0.9))), true);
    const PictureSampler sampler(scene, settings(plain_walks()));
    for (std::uint32_t pixel = 0; pixel < 256; ++pixel) EXPECT_EQ(remedies(scene, sampler, {pixel, 0}, 2), Remedies());
}

TEST(Remedies, NotWhatTheSceneRefuses) {
    Scene scene = under_glass(matte(0.8), true);
    scene.hide_emitters = true;
    EXPECT_EQ(remedies_of_largest(scene, settings(plain_walks()), 2), Remedies());
}

// In both halves nothing is left to try but bounces that are made from both ends.
TEST(Remedies, OfOtherMethods) {
    const Scene scene = under_glass(matte(0.8), true);
    const auto remedies_of = [&](const std::shared_ptr<const PathMethod>& method, std::size_t quantity) {
        return remedies(scene, PictureSampler(scene, settings(method)), {0, 0}, quantity);
    };
    EXPECT_EQ(remedies_of(physics::paths_of(method::Pointwise{}), 2), Remedies{Remedy::bidirectional});
    EXPECT_EQ(remedies_of(physics::paths_of(method::Surface{}), 2), Remedies{Remedy::sample_lights});
    EXPECT_EQ(remedies_of(std::make_shared<const LightPaths>(), 2), Remedies{Remedy::bidirectional});
    EXPECT_EQ(remedies_of(std::make_shared<const BidirectionalPaths>(), 2), Remedies());
    EXPECT_EQ(remedies_of(std::make_shared<const BidirectionalPaths>(), bounces + 1), Remedies{Remedy::more_bounces});
}

}  // namespace neumann::remedies_test
