// Every way to find the light of a reflection, and every choice of light, gives the same answer.
#include "core/emitter/light_sampler.h"
#include "core/sampling/sampler.h"
#include "operators/paths/walk/learned_visibility.h"
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"
#include "tests/physics/today.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <glm/gtc/matrix_transform.hpp>

namespace neumann::physics::direct_strategies_test {

using Settings = DirectLightSettings;

constexpr LightChoice choices[] = {LightChoice::mixed, LightChoice::uniform, LightChoice::power, LightChoice::contribution,
                                   LightChoice::seen,  LightChoice::tree,    LightChoice::all};

constexpr LightPlace places[] = {LightPlace::area, LightPlace::solid_angle, LightPlace::projected, LightPlace::near_projected};

// What is learned by walks of a camera that looks down.
std::shared_ptr<const LightVisibility> learned_from(SceneMaker maker, const Vec3& eye, double fov) {
    maker.parts.camera.to_world =
        glm::inverse(glm::lookAt(eye, eye - Vec3(0, 0, 1), Vec3(0, 1, 0))) * glm::scale(Mat4(1.0), Vec3(-1, 1, -1));
    maker.parts.camera.fov = fov;
    maker.parts.film = {48, 48, 0, 0, 48, 48, BoxFilter()};
    return learn_visibility(maker.make(), 3);
}

// By points on lights, and both.
std::vector<Settings> ways_to_sample_lights(const std::shared_ptr<const LightVisibility>& visibility) {
    std::vector<Settings> all;
    for (const LightChoice lights : choices)
        for (const LightPlace place : places) {
            if (place == LightPlace::near_projected && lights != LightChoice::mixed) continue;
            for (const DirectLight direct : {DirectLight::light, DirectLight::mis})
                all.push_back({direct, lights, place, Heuristic::power, visibility});
        }
    all.push_back({.heuristic = Heuristic::balance});
    return all;
}
bool samples_lights(const Settings& s) { return s.direct == DirectLight::light || s.direct == DirectLight::mis; }
std::string describe(const Settings& s) {
    return fmt::format("direct {}, lights {}, place {}, heuristic {}", static_cast<int>(s.direct), static_cast<int>(s.lights),
                       static_cast<int>(s.place), static_cast<int>(s.heuristic));
}

// A room with lights of all kinds of shapes and of very different brightness, and a ball that throws shadows.
SceneMaker many_lights() {
    SceneMaker maker;
    maker.add(room({-2, -2, 0}, {2, 2, 2.2}), matte(0.6));
    maker.add(strips({-1, -1, 2}, {0, 0.5, 0}, {0.5, 0, 0}, 3), lamp(5.0));
    maker.add(icosphere(1), matte(0.4));
    for (Vec3& v : std::get<TriangleMesh>(maker.parts.shapes.back()).vertices) v = v * 0.3 + Vec3(1, 0, 0.4);
    maker.add(icosphere(0), lamp(0.7));
    for (Vec3& v : std::get<TriangleMesh>(maker.parts.shapes.back()).vertices) v = v * 0.2 + Vec3(0.5, 1.2, 0.6);
    maker.add(Sphere{{-1.2, 0.8, 1.0}, 0.15, false}, lamp(20.0));
    maker.add(Disk{{1.2, -1.2, 1.5}, {0.3, 0, 0}, {0, 0.3, 0}, {0, 0, -1}}, lamp(3.0));
    return maker;
}

// A corner of a unit square at height 1: F = 0.1385316059948930 (direct_light.cpp). 49 comparisons.
TEST(DirectStrategiesSlow, ARectangleByLambertsFormula) {
    SceneMaker maker;
    maker.add(patch({0, 0, 0}, {0, 0, 1}, 0.01), matte(0.7));
    maker.add(parallelogram({0, 0, 1}, {0, 1, 0}, {1, 0, 0}), lamp(3.0));
    const Scene scene = maker.make();
    const StartPicker start = at(scene, {0, 0, 0}, {0, 0, 1});
    std::vector<Settings> settings = ways_to_sample_lights(learned_from(maker, {0, 0, 0.5}, 0.04));
    for (const DirectLight direct : {DirectLight::hemisphere, DirectLight::cosine, DirectLight::bsdf, DirectLight::surfaces})
        settings.push_back({.direct = direct});
    for (const Settings& s : settings) {
        SCOPED_TRACE(describe(s));
        const Estimates found = probe(scene, start, Technique::mis, {.samples = 512, .bounces = 2, .direct = s});
        expect_matches(found, std::vector{0.0, 0.7 * 3.0 * 0.1385316059948930, 0.0}, 0, samples_lights(s) ? power : 0.01);
    }
}

// One sample's variance below the ceiling of a unit cube, all of it a lamp: F (1 − F) of directions by their cosine, and two
// integrals (quadrature to 1e-8).
TEST(DirectStrategiesSlow, VariancesBelowACeiling) {
    SceneMaker maker;
    maker.add(patch({0.5, 0.5, 0}, {0, 0, 1}, 0.01), matte(1.0));
    maker.add(parallelogram({0, 0, 1}, {0, 1, 0}, {1, 0, 0}), lamp(1.0));
    const Scene scene = maker.make();
    for (const auto& [direct, variance] :
         {std::pair(DirectLight::cosine, 0.18211707), std::pair(DirectLight::hemisphere, 0.39080404),
          std::pair(DirectLight::bsdf, 0.18211707), std::pair(DirectLight::light, 0.00174051)}) {
        const Estimates found = probe(scene, at(scene, {0.5, 0.5, 0}, {0, 0, 1}), Technique::mis,
                                      {.samples = 1 << 14,
                                       .bounces = 1,
                                       .sampler = SamplerKind::independent,
                                       .direct = DirectLightSettings{.direct = direct}});
        expect_matches(found.variance[1], variance, std::to_string(static_cast<int>(direct)), 0.005);
    }
}

// Bounces 1 to 3 on the floor, against the plain walk by directions of the material. 144 comparisons of two estimates at 4.5
// standard errors; a third of the ways a day.
TEST(DirectStrategiesSlow, ManyLights) {
    const SceneMaker maker = many_lights();
    const Scene scene = maker.make();
    const StartPicker start = anywhere_on(scene, static_cast<std::uint32_t>(floor));
    const Estimates plain = probe(scene, start, Technique::bsdf, {.samples = 32768, .bounces = 3, .seed = fixed_seed + 1});
    std::vector<Settings> settings = ways_to_sample_lights(learned_from(maker, {0.2, -0.4, 1.8}, 1.5));
    for (const DirectLight direct : {DirectLight::hemisphere, DirectLight::cosine, DirectLight::surfaces})
        settings.push_back({.direct = direct});
    std::size_t number = 0;
    for (const Settings& s : settings) {
        if (!is_of_today(number++)) continue;
        SCOPED_TRACE(describe(s));
        const Estimates found =
            probe(scene, start, Technique::mis, {.samples = samples_lights(s) ? 4096u : 16384u, .bounces = 3, .direct = s});
        for (std::size_t i = 1; i <= 3; ++i) {
            const Statistic &a = found.terms[i], &b = plain.terms[i];
            EXPECT_NEAR(a.mean.r, b.mean.r, 4.5 * std::hypot(a.standard_error.r, b.standard_error.r)) << "bounce " << i;
            EXPECT_LT(a.standard_error.r, (samples_lights(s) ? 0.01 : 0.05) * a.mean.r) << "no power in bounce " << i;
        }
    }
}

// The example of Bikker, Probability Theory for Physically Based Rendering, part 2: four lights with potential contributions I · SA
// of 0.01, 5.02, 2.77 and 0.59 are chosen where their cdf, 0.1%, 60%, 93% and 100%, says. Four balls that are as far away.
TEST(DirectStrategies, ChooseByTheCdfOfTheContributions) {
    constexpr std::array contributions{0.01, 5.02, 2.77, 0.59};
    SceneMaker maker;
    maker.add(Sphere{{2, 0, 0}, 0.1, false}, lamp(contributions[0]));
    maker.add(Sphere{{0, 2, 0}, 0.1, false}, lamp(contributions[1]));
    maker.add(Sphere{{0, 0, 2}, 0.1, false}, lamp(contributions[2]));
    maker.add(Sphere{{-2, 0, 0}, 0.1, false}, lamp(contributions[3]));
    const Scene scene = maker.make();
    const LightSampler lights(scene.geometry, scene.emitters, LightChoice::contribution);
    constexpr int numbers = 100'000;
    std::array<double, 4> chosen{};
    for (int i = 0; i < numbers; ++i)
        chosen[lights.sample(Receiver(Vec3(0.0)), Vec2((i + 0.5) / numbers, 0.5), 0).point.shape] += 1.0 / numbers;
    double cdf = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        cdf += chosen[i];
        sum += contributions[i];
        EXPECT_NEAR(cdf, sum / 8.39, 1.0 / numbers) << "light " << i + 1;
    }
}

// Eight balls as bright and as far away as each other, seven of them behind a wall: the walls' side of the floor sees one. By
// contribution alone a sample chooses it with probability 1/8. Where n rays have learned that it is seen and the others are not,
// with p = √((n + 1)/(n + 2)) / (√((n + 1)/(n + 2)) + 7 √(1/(n + 2))) or less if some rays went elsewhere; of n ≥ 30, p ≥ 0.44. The
// second moment of a sample is f²/p, so that the standard deviation falls from √7 f to 1.13 f.
TEST(DirectStrategies, LightsThatAreSeenAreChosen) {
    SceneMaker maker;
    maker.add(parallelogram({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), matte(0.5));
    maker.add(parallelogram({-3, 1.5, -1}, {6, 0, 0}, {0, 0, 6}), black());
    const Vec3 x(0.0), seen(0, 0, 3);
    maker.add(Sphere{seen, 0.1, false}, lamp(1.0));
    for (int k = 0; k < 7; ++k) {
        const double angle = 0.4 + 0.33 * k;
        maker.add(Sphere{3.0 * Vec3(0.3 * std::cos(angle), std::sqrt(0.75), std::sqrt(0.25 - 0.09 * std::pow(std::cos(angle), 2))),
                         0.1, false},
                  lamp(1.0));
    }
    const Scene scene = maker.make();
    const auto visibility = learned_from(maker, {0, 0, 2}, 1.0);
    const auto probability = [&](LightChoice choice) {
        const LightSampler lights(scene.geometry, scene.emitters, choice, LightPlace::area, visibility);
        constexpr int numbers = 10'000;
        int chosen = 0;
        for (int i = 0; i < numbers; ++i) chosen += lights.sample({x, {0, 0, 1}}, Vec2((i + 0.5) / numbers, 0.5)).point.shape == 2;
        return static_cast<double>(chosen) / numbers;
    };
    EXPECT_NEAR(probability(LightChoice::contribution), 1.0 / 8.0, 1e-3);
    EXPECT_GT(probability(LightChoice::seen), 0.44);
    // No light is given up: one may be seen from where no ray has begun.
    const LightSampler lights(scene.geometry, scene.emitters, LightChoice::seen, LightPlace::area, visibility);
    for (std::uint32_t shape = 2; shape < 10; ++shape) {
        const SurfacePoint y = scene.geometry.point(scene.geometry.primitive_ref(shape, 0), {0.99, 0.5});
        EXPECT_GT(lights.pdf({x, {0, 0, 1}}, glm::normalize(y.position), y), 0.0) << shape;
    }
}

// sample() tells the density that pdf() tells of what it has found, and that density has no more than 1 in all. The plain choice
// tells both with the same arithmetic, the others to rounding.
TEST(DirectStrategies, DensitiesAreThoseOfSamples) {
    SceneMaker maker = many_lights();
    maker.parts.lights.environment = ConstantEnvironment(Rgb(0.2));
    const Scene scene = maker.make();
    const auto visibility = learned_from(maker, {0.2, -0.4, 1.8}, 1.5);
    for (const LightChoice choice : choices)
        for (const LightPlace place : places) {
            const LightSampler lights(scene.geometry, scene.emitters, choice, place, visibility);
            Sampler sampler(fixed_seed, 0);
            for (std::uint64_t i = 0; i < 4000; ++i) {
                sampler.start(i);
                const Vec3 x(4.0 * sampler.next() - 2.0, 4.0 * sampler.next() - 2.0, 0.5 * sampler.next());
                const Receiver from = i % 2 == 0 ? Receiver(x) : Receiver(x, uniform_sphere(sampler.next2()));
                const LightSample light = lights.sample(from, sampler.next2(), i % lights.samples_per_point());
                if (!(light.pdf > 0.0) || light.pdf == delta_pdf) continue;
                EXPECT_NEAR(lights.pdf(from, light.w, light.point) / light.pdf, 1.0, 1e-9) << static_cast<int>(choice) << i;
            }
        }
}

// Below a large lamp: the rectangle's variance is not above that of its two triangles, which a mesh is cut into where their order
// keeps them apart. Of a light of constant radiance, seen unobstructed, f cosθ is all that varies.
TEST(DirectStrategiesSlow, ARectangleHasNoMoreVarianceThanItsTriangles) {
    const auto variance = [](bool rectangle) {
        SceneMaker maker;
        maker.add(patch({0.2, 0.3, 0}, {0, 0, 1}, 0.01), matte(0.8));
        TriangleMesh lamp_mesh = parallelogram({-0.5, -0.5, 0.5}, {0, 2, 0}, {2, 0, 0});
        if (!rectangle) {
            // A triangle far away between the two.
            const auto first = static_cast<std::uint32_t>(lamp_mesh.vertices.size());
            for (const Vec3& v : {Vec3(0, 0, 900), Vec3(0, 1e-6, 900), Vec3(1e-6, 0, 900)}) lamp_mesh.vertices.push_back(v);
            lamp_mesh.triangles.insert(lamp_mesh.triangles.begin() + 1, {first, first + 1, first + 2});
        }
        maker.add(lamp_mesh, lamp(2.0));
        const Scene scene = maker.make();
        return probe(scene, at(scene, {0.2, 0.3, 0}, {0, 0, 1}), Technique::light,
                     {.samples = 1 << 13,
                      .bounces = 1,
                      .sampler = SamplerKind::independent,
                      .direct = DirectLightSettings{.direct = DirectLight::light, .place = LightPlace::solid_angle}});
    };
    const Estimates whole = variance(true), cut = variance(false);
    EXPECT_NEAR(whole.terms[1].mean.r, cut.terms[1].mean.r,
                4.5 * std::hypot(whole.terms[1].standard_error.r, cut.terms[1].standard_error.r));
    EXPECT_LT(whole.variance[1].mean.r - 4.5 * whole.variance[1].standard_error.r, cut.variance[1].mean.r);
    EXPECT_LT(whole.variance[1].mean.r, 1.02 * cut.variance[1].mean.r);
}

}  // namespace neumann::physics::direct_strategies_test
