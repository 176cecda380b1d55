// Rays that go on from mirrors, glass and rough metal: as parts of T, as light from the lamps, and in pictures.
#include "operators/fields/matrix/link_light.h"

#include "core/base/error.h"
#include "core/emitter/sun_radiance.h"
#include "core/sampling/sampler.h"
#include "operators/experiments/known/scene_maker.h"
#include "operators/fields/matrix/light_vector.h"
#include "operators/fields/matrix/scene_patches.h"
#include "operators/fields/matrix/transport_matrix.h"
#include "operators/render/from_fields/field_rendering.h"
#include "operators/render/from_fields/link_raster.h"
#include "operators/render/from_paths/rendered_series.h"
#include "operators/render/methods/render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>

namespace neumann::links_test {

using namespace known;

struct Ball {
    std::string name;
    Surface surface;
    friend std::ostream& operator<<(std::ostream& out, const Ball& ball) { return out << ball.name; }
};
std::vector<Ball> balls() {
    return {{"glass", boundary(Dielectric(1.5), Dielectric(1.0 / 1.5))},
            {"mirror", made_of(Conductor())},
            {"film", boundary(ThinDielectric(1.5), ThinDielectric(1.5))},
            {"rough_metal", made_of(RoughConductor<Ggx>(Ggx(0.2)))}};
}

// Along y, at the ball and the walls behind it.
void look(SceneMaker& maker, int size) {
    maker.parts.camera = {
        .to_world = Mat4({-1, 0, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 0}, {0.05, -0.95, -0.1, 1}), .fov = 0.5 * pi, .near_clip = 1e-3};
    maker.parts.film = {size, size, 0, 0, size, size};
}

// A closed room in which only the ball is not diffuse. The lamp is the ceiling, or hangs below it.
Scene room_with(const Ball& ball, bool small_lamp, double rho = 0.5) {
    SceneMaker maker;
    const auto walls = room({-1, -1, -1}, {1, 1, 1});
    for (const std::size_t face : {left, right, front, back, floor}) maker.add(walls[face], matte(rho));
    maker.add(walls[ceiling], small_lamp ? matte(rho) : glowing(rho, 1.0));
    if (small_lamp) maker.add(parallelogram({-0.1, -0.1, 0.9}, {0, 0.2, 0}, {0.2, 0, 0}), lamp(50.0));
    maker.add(Sphere{{0.1, -0.2, -0.3}, 0.5, false}, ball.surface);
    look(maker, 16);
    return maker.make();
}

class Links : public testing::TestWithParam<Ball> {};
INSTANTIATE_TEST_SUITE_P(BallsSlow, Links, testing::ValuesIn(balls()), [](const auto& ball) { return ball.param.name; });

// The power that comes to the walls by m links is the same from the walls' rays and from the lamp's: |z| ≤ 4.5 in each of 6
// bounces, a false alarm in 1 of 20,000 runs.
TEST_P(Links, BringTheSamePowerFromBothEnds) {
    constexpr int N = 6, seeds = 12;
    const Scene scene = room_with(GetParam(), false);
    const PatchSpace space = scene_patches(scene, {.patches = 300}, Glossy::by_rays);
    const ExitantVector<1> Le = emitted_light<1>(scene, space);
    const auto power = [&](const IncidentVector<1>& means) {
        double sum = 0.0;
        for (std::uint32_t u = 0; u < space.size(); ++u) sum += means(0, u) * space.measure(space.facets()[space.facet_of(u)]);
        return sum;
    };
    std::array<std::array<std::vector<double>, 2>, N + 1> found;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        Chains chains(scene, space, 256, seed, N);
        const RayTable table(space, 256, seed, {}, [&](const BlindRay& ray) { chains.follow(ray); });
        chains.finish();
        const ArrivingByLinks<1> light = arriving_by_links<1>(scene, RowShare(space), 4e5, seed, N);
        for (int m = 1; m < N; ++m) {
            IncidentVector<1> means = IncidentVector<1>::zero(space.size());
            chains.add<1>([&](int links) { return links == m ? &Le : nullptr; }, means);
            found[static_cast<std::size_t>(m)][0].push_back(power(means));
            found[static_cast<std::size_t>(m)][1].push_back(power(light.radiance[static_cast<std::size_t>(m) + 1]));
        }
    }
    double all = 0.0;
    for (int m = 1; m < N; ++m) {
        double mean[2], variance = 0.0;
        for (const std::size_t end : {0u, 1u}) {
            const std::vector<double>& x = found[static_cast<std::size_t>(m)][end];
            mean[end] = std::accumulate(x.begin(), x.end(), 0.0) / seeds;
            for (const double v : x) variance += (v - mean[end]) * (v - mean[end]) / (seeds * (seeds - 1.0));
        }
        all += mean[1];
        // Of so few seeds t would be wider; the sum of two spreads makes up for it.
        EXPECT_NEAR(mean[0], mean[1], 5.5 * std::sqrt(variance) + 1e-12) << m << " links";
    }
    EXPECT_GT(all, 0.01) << "something comes by links";
}

// Where all walls shine alike and the ball takes nothing, L = Le / (1 − ρ) from everywhere, also in the ball and through it.
TEST_P(Links, LeaveAFurnaceAsItIs) {
    SceneMaker maker;
    maker.add(room({-1, -1, -1}, {1, 1, 1}), glowing(0.5, 1.0));
    maker.add(Sphere{{0.1, -0.2, -0.3}, 0.5, false}, GetParam().surface);
    look(maker, 12);
    const Scene scene = maker.make();
    // Rough metal loses what its microfacets would reflect a second time: the walk tells how much of ten bounces.
    std::optional<MeanWithError> walked;
    if (GetParam().name == "rough_metal") {
        PictureSampler::Settings walk;
        walk.walk.bounces = 10;
        walk.replicate_size = replicate_size(1024);
        walked = render_series(scene, walk, {1024, {}, {}}).moments.result().mean_of_sum(10);
    }
    for (const FieldReading reading : {FieldReading::matrix, FieldReading::gather})
        for (const int bounces : {0, 10}) {
            if (walked && bounces < 10) continue;
            FieldSettings settings;
            settings.reading = reading;
            settings.bounces = bounces;
            settings.patching.patches = 100;
            settings.samples = 16;
            const FieldPictures found = *render_fields(scene, settings);
            const MeanWithError sum = found.mean_of_sum(static_cast<std::size_t>(bounces)), rest = found.mean_of_rest();
            const double expected = walked ? walked->mean + rest.mean : 2.0, error = walked ? 4.5 * walked->standard_error : 1e-4;
            const double sampled = std::hypot(sum.standard_error, bounces == 0 ? rest.standard_error : 0.0);
            // What pixels sample, bounce 1: t of 3 degrees of freedom is below 12.9 in 99.9%.
            EXPECT_NEAR(sum.mean + rest.mean, expected, 12.9 * sampled + error) << bounces << " bounces";
            EXPECT_LT(sampled, 0.01);
            EXPECT_FALSE(found.power.is_sick());
        }
}

// A lamp that the rays of T do not find: the pictures' means are those of a room without patches, by the walk in
// tests/agreement/fields.cpp; here the two readings, which find caustics in different ways, agree, and the power balances.
TEST_P(Links, OfASmallLampBalance) {
    const Scene scene = room_with(GetParam(), true);
    FieldSettings settings;
    settings.bounces = 6;
    settings.patching.patches = 1500;
    settings.rays = 128;
    settings.light_samples = 64;
    settings.samples = 64;
    const FieldPictures read = *render_fields(scene, settings);
    settings.reading = FieldReading::gather;
    settings.seed = 1;
    const FieldPictures gathered = *render_fields(scene, settings);
    for (std::size_t i = 2; i <= 6; ++i) {
        const MeanWithError a = read.mean_of_term(i), b = gathered.mean_of_term(i);
        // Patches may make 2%; t of 3 degrees of freedom is below 12.9 in 99.9%.
        EXPECT_NEAR(a.mean, b.mean, 12.9 * std::hypot(a.standard_error, b.standard_error) + 0.02 * a.mean) << "bounce " << i;
    }
    EXPECT_FALSE(read.power.is_sick());
}

// What a light from afar brings counts as what arrives.
TEST(LinksFromAfarSlow, Balance) {
    SceneMaker maker;
    maker.add(parallelogram({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), matte(0.6));
    maker.add(Sphere{{0, 0, 0.5}, 0.4, false}, made_of(Conductor()));
    maker.parts.lights.environment = ConstantEnvironment(grey(1.0));
    const Scene scene = maker.make();
    FieldSettings settings;
    settings.bounces = 5;
    settings.patching.patches = 500;
    const FieldPictures found = *render_fields(scene, settings);
    EXPECT_FALSE(found.power.is_sick());
    EXPECT_GT(found.power.bounces[0].arrived.mean, 1.0);
}

// A ball on the ground in the sun: bounces 1 and 2 of fields and of the walk. Patches may make 2%; 12.9 as above; an error of
// 12% is seen for sure.
TEST(LinksFromAfarSlow, TheSunAndTheSky) {
    const double elevation = 0.7, sun_radius = 0.5 * glm::radians(sun_angle);
    SceneMaker maker;
    maker.add(parallelogram({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}), matte(0.6));
    maker.add(Sphere{{0.1, -0.1, -0.6}, 0.4, false}, matte(0.8));
    maker.parts.lights.environment = SunSky({0, 0, 1}, {0.0, -std::cos(elevation), std::sin(elevation)},
                                            SkyModel(3.0, grey(0.3), elevation), 1.0, grey(15000.0), sun_radius);
    look(maker, 16);
    const Scene scene = maker.make();
    PictureSampler::Settings walk;
    walk.walk.bounces = 2;
    walk.replicate_size = replicate_size(16384);
    const auto walked = render_series(scene, walk, {16384, {}, {}}).moments.result();
    FieldSettings settings;
    settings.bounces = 2;
    settings.patching.patches = 3000;
    settings.samples = 1024;
    settings.light_samples = 64;
    settings.rays = 1024;
    for (const FieldReading reading : {FieldReading::matrix, FieldReading::gather}) {
        settings.reading = reading;
        const FieldPictures found = *render_fields(scene, settings);
        for (std::size_t i = 1; i <= 2; ++i) {
            const MeanWithError a = found.mean_of_term(i), b = walked.mean_of_term(i);
            EXPECT_NEAR(a.mean, b.mean, 12.9 * a.standard_error + 4.5 * b.standard_error + 0.02 * b.mean) << "bounce " << i;
            EXPECT_LT(12.9 * a.standard_error + 4.5 * b.standard_error, 0.1 * b.mean) << "bounce " << i << ": no power";
        }
        EXPECT_FALSE(found.power.is_sick());
    }
}

// The sky through a slit in the ceiling reaches a mirror floor; on most patches a pilot finds nothing. Still no path brings more
// than 4 times what paths do that are spread evenly: 4 A E / n, with E = 4π of the sky and A the area of both sides.
TEST(LinksFromAfar, AreNotCarriedByAFewPaths) {
    SceneMaker maker;
    const auto walls = room({-1, -1, -1}, {1, 1, 1});
    for (const std::size_t face : {left, right, front, back}) maker.add(walls[face], matte(0.5));
    maker.add(walls[floor], made_of(Conductor()));
    for (const double x : {-1.0, 0.01}) maker.add(parallelogram({x, -1, 1}, {0, 2, 0}, {0.99, 0, 0}), matte(0.5));
    maker.parts.lights.environment = ConstantEnvironment(grey(1.0));
    const Scene scene = maker.make();
    const PatchSpace space = scene_patches(scene, {.patches = 1000}, Glossy::by_rays);
    constexpr double both_sides = 8.0, rays_of_path = 4.0;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        constexpr double rays = 4e5;
        const LinkLight light(scene, space, rays, seed, 3);
        const double most = 4.0 * both_sides * 4.0 * pi / (rays / rays_of_path);
        std::size_t arrived = 0;
        double largest = 0.0;
        const auto trace = [&](std::size_t part) {
            std::vector<double> powers;
            std::vector<PowerOfTerm> on_its_way(4);
            light.trace(part, on_its_way, [&](const LinkArrival& a) { powers.push_back(mean_component(a.power)); });
            return powers;
        };
        light.for_parts(trace, [&](const std::vector<double>& powers) {
            arrived += powers.size();
            for (const double p : powers) largest = std::max(largest, p);
        });
        EXPECT_GT(arrived, 20u);
        EXPECT_LE(largest, most * (1.0 + 1e-12));
    }
}

// Smooth plastic and holes send light in single directions and in all: seen in a mirror they ask the lamp as well, rough glass does
// so from inside, too, and each bounce is the walk's, within 4.5 of its standard errors and t of 3 degrees of freedom in 99.9%, in
// both readings.
TEST(LinksOfAnyMaterialSlow, AreSeenInAMirrorAsTheyAre) {
    const auto matt = std::make_shared<const Bsdf>(Diffuse(Rgb(0.7)));
    const Bsdf plastic(Plastic(1.5, Rgb(0.7), Rgb(1.0), false)), mask(Mask(matt, Rgb(0.6)));
    const auto rough_glass = [](double eta) { return RoughDielectric<Ggx>(Ggx(Vec2(0.4)), eta); };
    for (const Surface& ball :
         {boundary(plastic, plastic), boundary(mask, mask), boundary(rough_glass(1.5), rough_glass(1.0 / 1.5))}) {
        SceneMaker maker;
        const auto walls = room({-1, -1, -1}, {1, 1, 1});
        for (const std::size_t face : {left, right, front, floor}) maker.add(walls[face], matte(0.5));
        maker.add(walls[back], made_of(Conductor()));
        maker.add(walls[ceiling], glowing(0.5, 1.0));
        maker.add(Sphere{{0.1, 0.4, -0.3}, 0.4, false}, ball);
        look(maker, 16);
        const Scene scene = maker.make();
        PictureSampler::Settings walk;
        walk.walk.bounces = 4;
        walk.replicate_size = replicate_size(2048);
        const RenderedSeries walked = render_series(scene, walk, {2048, {}, {}});
        for (const FieldReading reading : {FieldReading::matrix, FieldReading::gather}) {
            FieldSettings settings;
            settings.reading = reading;
            settings.bounces = 4;
            settings.patching.patches = 2000;
            settings.rays = 256;
            settings.samples = 64;
            settings.gather_rays = 16;
            settings.light_samples = 64;
            const FieldPictures found = *render_fields(scene, settings);
            for (std::size_t k = 1; k <= 4; ++k) {
                const MeanWithError a = found.mean_of_term(k), b = walked.moments.result().mean_of_term(k);
                // Patches make up to half a percent.
                EXPECT_NEAR(a.mean, b.mean, 12.9 * a.standard_error + 4.5 * b.standard_error + 0.005 * b.mean) << "bounce " << k;
                EXPECT_LT(a.standard_error, 0.003 * a.mean);
            }
        }
    }
}

// Of a point lamp a mirror throws light on by a link; where its directions are cells, that is missing, and told.
TEST(LinksOfAnyMaterial, WhatIsMissingWithoutThemIsTold) {
    SceneMaker maker;
    maker.add(room({-1, -1, -1}, {1, 1, 1}), matte(0.5));
    maker.add(Sphere{{0.1, -0.2, -0.3}, 0.5, false}, made_of(Conductor()));
    maker.parts.lights.delta.push_back(PointLight({0.2, 0.1, 0.7}, Rgb(1.0)));
    look(maker, 8);
    const Scene scene = maker.make();
    Goal goal;
    goal.bounces = 2;
    goal.samples = 4;
    const auto is_reported = [&](const Method& method) {
        const auto warnings = render(scene, method, goal).warnings.counts();
        return std::ranges::any_of(warnings, [](const auto& w) {
            return w.first.find("a mirror throws on from a light without extent") != std::string::npos;
        });
    };
    method::Patches in_cells;
    method::Matrix by_links;
    in_cells.patches = by_links.patches = 60;
    EXPECT_TRUE(is_reported(in_cells));
    EXPECT_FALSE(is_reported(by_links));
    EXPECT_TRUE(is_reported(method::Walk{}));
}

// Anisotropic metal has no cells of directions, and needs none.
TEST(LinksOfAnyMaterial, NeedNoCells) {
    const Scene scene = room_with({"brushed", made_of(RoughConductor<Ggx>(Ggx(Vec2(0.1, 0.3))))}, false);
    FieldSettings settings;
    settings.bounces = 3;
    settings.patching.patches = 100;
    EXPECT_TRUE(render_fields(scene, settings).has_value());
    settings.reading = FieldReading::patches;
    EXPECT_THROW(render_fields(scene, settings), InputError);
}

class LinkRasters : public testing::Test {
protected:
    LinkRasters() {
        SceneMaker maker;
        maker.add(parallelogram({0, 0, 0}, {2, 0, 0}, {0, 3, 0}), matte(0.5));
        maker.add(Sphere{{0, 0, 5}, 1.0, false}, matte(0.5));
        scene.emplace(maker.make());
        patches.emplace(scene->geometry, Patching{.patches = 50});
    }
    std::optional<Scene> scene;
    std::optional<Patches> patches;
};

// Cells keep the power, whatever their sizes, and so do those one size larger.
TEST_F(LinkRasters, KeepPower) {
    for (const std::size_t n : {0u, 10u, 100000u}) {
        std::vector<LinkRaster::End> ends;
        Sampler random(1, 0);
        for (std::size_t i = 0; i < n; ++i) {
            random.start(i);
            const Vec2 u = random.next2();
            ends.emplace_back(0, true, Vec2(u.x, u.y * u.y), 2, Rgb(1.0));
        }
        const LinkRaster raster(*patches, ends, 3);
        double fine = 0.0, coarse = 0.0;
        constexpr int k = 1024;
        for (int i = 0; i < k; ++i)
            for (int j = 0; j < k; ++j) {
                const auto reading = raster.read(0, true, {(i + 0.5) / k, (j + 0.5) / k});
                fine += double{reading.fine[0]};
                coarse += double{reading.coarse[0]};
            }
        const double to_power = pi * 6.0 / (k * k);
        EXPECT_NEAR(fine * to_power, static_cast<double>(n), 1e-4 * static_cast<double>(n));
        EXPECT_NEAR(coarse * to_power, static_cast<double>(n), 1e-4 * static_cast<double>(n));
        EXPECT_EQ(raster.read(0, false, {0.5, 0.5}).fine[0], 0.0f);
        EXPECT_EQ(raster.read(1, true, {0.5, 0.5}).fine[0], 0.0f);
    }
}

// A spot a hundredth wide is found at its own density, and darkness beside it. With 200,000 ends in it cells are 1/4096 wide, for
// those hold 119, fewer than `enough_ends`, and those twice as wide 477. 32 × 32 cells within the spot are 61% of it, and their
// mean is known to the standard error of a binomial distribution, 0.18%. Cells differ from the density by that of 119 ends, 9.2%,
// and 1024 of them know this to 1/√2048. Each is beyond 4.5 standard errors in 7 of a million seeds.
TEST_F(LinkRasters, AreSharp) {
    std::vector<LinkRaster::End> ends;
    Sampler random(2, 0);
    for (std::size_t i = 0; i < 200000; ++i) {
        random.start(i);
        ends.emplace_back(0, true, Vec2(0.5) + 0.01 * random.next2(), 4, Rgb(1.0));
    }
    const LinkRaster raster(*patches, ends, 3);
    const double density = 200000.0 / (pi * 6.0 * 1e-4);
    constexpr int cells = 32, first = 2053;  // from 0.50122 to 0.50903
    const double share = 1e4 / 16384.0, in_cell = share * 200000.0 / (cells * cells);
    double mean = 0.0, squares = 0.0;
    for (int x = 0; x < cells; ++x)
        for (int y = 0; y < cells; ++y) {
            const double found = raster.read(0, true, {(first + x + 0.5) / 4096.0, (first + y + 0.5) / 4096.0}).fine[6];
            mean += found / (cells * cells);
            squares += (found - density) * (found - density) / (cells * cells);
        }
    EXPECT_NEAR(mean, density, 4.5 * std::sqrt((1.0 - share) / (share * 200000.0)) * density);
    EXPECT_NEAR(std::sqrt(squares * in_cell) / density, 1.0, 4.5 / std::sqrt(2.0 * cells * cells));
    EXPECT_EQ(raster.read(0, true, {0.48, 0.505}).fine[6], 0.0f);
}

}  // namespace neumann::links_test
