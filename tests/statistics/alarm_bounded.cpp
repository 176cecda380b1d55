// One scene, one verdict: where no sample can exceed a bound, no method may say that the variance is infinite.
#include "core/emitter/environment_map.h"
#include "operators/paths/guided/guide.h"
#include "operators/render/from_paths/bounded_samples.h"
#include "operators/render/from_paths/guided_paths.h"
#include "operators/render/from_paths/splat_sampler.h"
#include "operators/render/report/series_report.h"
#include "tests/physics/paths_of.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

namespace neumann::alarm_bounded_test {

using namespace physics;

constexpr int bounces = 6;
constexpr double sun = 60.0;

// A floor, glass, silver and a rough metal under a dark sky with a sun 8° in radius, all of which walks can find by chance.
Scene balls(int resolution) {
    SceneMaker maker;
    Surface ground = matte(0.6);
    ground.two_sided = true;
    maker.add(parallelogram({-3, -3, 0}, {6, 0, 0}, {0, 6, 0}), ground);
    maker.add(Sphere{{-1.1, 0, 0.5}, 0.5, false}, boundary(Dielectric(1.5), Dielectric(1.0 / 1.5)));
    maker.add(Sphere{{0, 0.3, 0.5}, 0.5, false}, made_of(Conductor({}, Rgb(0.95))));
    maker.add(Sphere{{1.1, 0, 0.5}, 0.5, false}, made_of(RoughConductor<Ggx>(Ggx(0.1), {}, Rgb(0.9))));
    Image sky(64, 32);
    for (int y = 0; y < sky.height; ++y)
        for (int x = 0; x < sky.width; ++x) {
            const bool is_sun = std::abs(x - 40) <= 1 && std::abs(y - 10) <= 1;
            sky.at(x, y) = Rgb(is_sun ? sun : y < 16 ? 0.6 : 0.1);
        }
    maker.parts.lights.environment = EnvironmentMap(sky, 1.0, Mat4({1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}, {0, 0, 0, 1}));
    maker.parts.film = {
        .width = resolution, .height = resolution, .crop_width = resolution, .crop_height = resolution, .filter = BoxFilter()};
    maker.parts.camera = {
        .to_world = Mat4({-1, 0, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 0}, {0, -4, 0.8, 1}), .fov = 0.7, .near_clip = 1e-3};
    return maker.make();
}

std::shared_ptr<const PathMethod> made(const std::string& method, const Scene& scene, std::uint64_t seed = 1) {
    if (method == "guided")
        return std::make_shared<const GuidedPaths>(
            std::make_shared<const Guide>(scene, GuideSettings{.patches = 200, .rays = 256, .bounces = bounces, .seed = seed}));
    if (method == "pointwise") return physics::paths_of(method::Pointwise{});
    if (method == "bidirectional") return std::make_shared<const BidirectionalPaths>();
    if (method == "light") return std::make_shared<const LightPaths>();
    if (method == "shooting") return physics::paths_of(method::Shooting{});
    if (method == "surface") return physics::paths_of(method::Surface{});
    if (method == "classic") return physics::paths_of(method::Classic{});
    return plain_walks();
}

SamplingSettings settings_of(const std::string& method, const Scene& scene, std::uint64_t seed) {
    return {.method = made(method, scene, seed),
            .walk = {.bounces = bounces, .rest_probability = method == "pointwise" ? 0.0 : 0.2},
            .seed = seed,
            .replicate_size = 8};
}

const std::string methods[] = {"walk", "guided", "pointwise", "bidirectional"};

// As many samples as the alarm wants, of every method. What it says of the tails is left to chance: some look infinite.
TEST(AlarmSlow, OneSceneHasOneVerdict) {
    const Scene scene = balls(36);
    int rare = 0, looked_at = 0;
    for (const std::string& method : methods)
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
            const RenderedSeries series = render_series(scene, settings_of(method, scene, seed), {64, std::nullopt, std::nullopt});
            const SeriesReport report = report_series(scene, series, RestVerdict::measured);
            EXPECT_FALSE(report.infinite_variance()) << method;
            EXPECT_FALSE(report.rest_infinite_variance) << method;
            for (const BounceReport& b : report.bounces) {
                EXPECT_FALSE(b.infinite_variance && b.rare_large_samples);
                rare += b.rare_large_samples;
                looked_at += b.tail.has_value();
            }
        }
    std::printf("glass and metals: %d of %d tails look infinite and are not\n", rare, looked_at);
    EXPECT_GT(looked_at, 30);
}

// Whatever becomes of later bounces, a sample of bounce 0 is at most the largest Le, unless lamps are joined to the lens.
TEST(BoundedSamples, OfEmissionThatRaysMeet) {
    const Scene scene = balls(4);
    for (const char* method : {"walk", "surface", "shooting", "classic", "light"}) {
        RenderedSeries series = render_series(scene, settings_of(method, scene, 1), {8, std::nullopt, std::nullopt});
        LargestSamples& emission = series.tally.largest[0];
        for (int i = 1; i <= 1000; ++i) emission.add(1e9 * std::pow(i, -1.0 / 1.2));
        emission.add_count(1'000'000);
        const SeriesReport report = report_series(scene, series, RestVerdict::measured);
        EXPECT_EQ(report.bounces[0].infinite_variance, std::string(method) == "light") << method;
        EXPECT_NE(report.bounces[0].infinite_variance, report.bounces[0].rare_large_samples) << method;
    }
}

// The rest, with samples added whose tail is that of an infinite variance: where that cannot be, they are rare and no more.
TEST(BoundedSamples, TheRestHasTheSameVerdict) {
    const Scene scene = balls(4);
    const auto verdict = [&](const std::string& method, const Roulette& roulette) {
        SamplingSettings settings = settings_of(method, scene, 1);
        settings.walk.roulette = roulette;
        RenderedSeries series = render_series(scene, settings, {8, std::nullopt, std::nullopt});
        LargestSamples& rest = series.tally.largest[bounces + 1];
        for (int i = 1; i <= 1000; ++i) rest.add(1e9 * std::pow(i, -1.0 / 1.2));
        rest.add_count(1'000'000);
        const SeriesReport report = report_series(scene, series, RestVerdict::measured);
        EXPECT_NE(report.rest_infinite_variance, report.rest_rare_large_samples);
        return report.rest_infinite_variance ? "infinite" : "rare";
    };
    for (const char* method : {"walk", "guided", "bidirectional"}) {
        EXPECT_STREQ(verdict(method, {}), "rare") << method;
        EXPECT_STREQ(verdict(method, {Roulette::Kind::albedo}), "rare") << method;
        // The largest albedo is that of glass.
        EXPECT_STREQ(verdict(method, {Roulette::Kind::fixed, 0.9}), "infinite") << method;
    }
    EXPECT_STREQ(verdict("light", {}), "infinite");
}

// The bound itself. Weights are at most 1 but in glass, whose n² cancel until a path has left it, so directions by the materials
// bring at most the sun; with questions for light at most half of it more; of the ways of bidirectional each brings at most half.
TEST(BoundedSamples, StayBelowTheirBound) {
    const Scene scene = balls(24);
    for (const std::string method : {"walk", "pointwise", "bidirectional"}) {
        const SamplingSettings settings = settings_of(method, scene, 1);
        ASSERT_TRUE(samples_are_bounded(scene, settings));
        const RenderedSeries series = render_series(scene, settings, {64, std::nullopt, std::nullopt});
        for (int i = 1; i <= bounces; ++i) {
            const double ways = method == "pointwise" ? 1.0 : method == "walk" ? 1.5 : 1.0 + 0.5 * (i + 1);
            const auto largest = series.tally.largest[static_cast<std::size_t>(i)].sorted();
            ASSERT_FALSE(largest.empty());
            EXPECT_LE(largest.front(), sun * ways * (1.0 + 1e-9)) << method << ", bounce " << i;
        }
    }
}

TEST(BoundedSamples, AreKnownByMethod) {
    const Scene sky = balls(8);
    SceneMaker maker;
    maker.add(parallelogram({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), matte(0.5));
    maker.parts.lights.delta = {PointLight(Vec3(0, 0, 1), Rgb(1.0))};
    const Scene point = maker.make();
    const auto bounded = [](const Scene& scene, const std::string& method, DirectLight direct = DirectLight::mis) {
        return samples_are_bounded(scene, {.method = made(method, scene), .walk = {.direct = {direct}}});
    };
    for (const std::string& method : methods) {
        EXPECT_TRUE(bounded(sky, method));
        EXPECT_FALSE(bounded(point, method)) << "1/d² near the light";
    }
    EXPECT_TRUE(bounded(sky, "walk", DirectLight::bsdf));
    EXPECT_FALSE(bounded(sky, "walk", DirectLight::light));
    EXPECT_FALSE(bounded(sky, "walk", DirectLight::surfaces));
    for (const char* method : {"surface", "light", "shooting", "classic"}) EXPECT_FALSE(bounded(sky, method));
    SamplingSettings ways;
    ways.method = std::make_shared<const BidirectionalPaths>(BidirectionalPaths::Quantities::ways);
    EXPECT_FALSE(samples_are_bounded(sky, ways));
}

// Of Ward's lobes only the balanced one has weights that are bounded.
TEST(BoundedSamples, NeedALargestAlbedo) {
    using Variant = WardLobe::Variant;
    for (const Variant variant : {Variant::original, Variant::duer, Variant::balanced}) {
        SceneMaker maker;
        maker.add(Sphere{{0, 0, 0}, 1.0, true}, glowing(0.5, 1.0));
        maker.add(Sphere{{0, 0, 0}, 0.3, false}, made_of(Ward(WardLobe(variant, Beckmann(0.2)), Rgb(0.5), Rgb(0.2))));
        EXPECT_EQ(samples_are_bounded(maker.make(), {}), variant == Variant::balanced);
    }
}

}  // namespace neumann::alarm_bounded_test
