// Every way to find the light of a reflection, and every choice of light, gives the same answer.
#include "core/emitter/light_sampler.h"
#include "core/sampling/sampler.h"
#include "core/sampling/spherical_rectangle.h"
#include "core/sampling/spherical_triangle.h"
#include "core/sampling/warp.h"
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>

namespace neumann::physics::direct_strategies_test {

using Settings = DirectLightSettings;

constexpr LightChoice choices[] = {LightChoice::mixed, LightChoice::uniform, LightChoice::power, LightChoice::contribution,
                                   LightChoice::all};

// By points on lights, and both.
std::vector<Settings> ways_to_ask_lights() {
    std::vector<Settings> all;
    for (const LightChoice lights : choices)
        for (const LightPlace place : {LightPlace::area, LightPlace::solid_angle}) {
            all.push_back({DirectLight::light, lights, place});
            all.push_back({DirectLight::mis, lights, place});
        }
    all.push_back({.heuristic = Heuristic::balance});
    return all;
}
bool asks_lights(const Settings& s) { return s.direct == DirectLight::light || s.direct == DirectLight::mis; }
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

// A corner of a unit square at height 1: F = 0.1385316059948930 (direct_light.cpp). 26 comparisons.
TEST(DirectStrategiesSlow, ARectangleByLambertsFormula) {
    SceneMaker maker;
    maker.add(patch({0, 0, 0}, {0, 0, 1}, 0.01), matte(0.7));
    maker.add(parallelogram({0, 0, 1}, {0, 1, 0}, {1, 0, 0}), lamp(3.0));
    const Scene scene = maker.make();
    const StartPicker start = at(scene, {0, 0, 0}, {0, 0, 1});
    std::vector<Settings> settings = ways_to_ask_lights();
    for (const DirectLight direct : {DirectLight::hemisphere, DirectLight::cosine, DirectLight::bsdf, DirectLight::surfaces})
        settings.push_back({.direct = direct});
    for (const Settings& s : settings) {
        SCOPED_TRACE(describe(s));
        const Estimates found = probe(scene, start, Technique::mis, {.samples = 512, .bounces = 2, .direct = s});
        expect_matches(found, std::vector{0.0, 0.7 * 3.0 * 0.1385316059948930, 0.0}, 0, asks_lights(s) ? power : 0.01);
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

// Bounces 1 to 3 on the floor, against the plain walk by directions of the material. 75 comparisons of two estimates at 4.5
// standard errors.
TEST(DirectStrategiesSlow, ManyLights) {
    const Scene scene = many_lights().make();
    const StartPicker start = anywhere_on(scene, static_cast<std::uint32_t>(floor));
    const Estimates plain = probe(scene, start, Technique::bsdf, {.samples = 32768, .bounces = 3, .seed = fixed_seed + 1});
    std::vector<Settings> settings = ways_to_ask_lights();
    for (const DirectLight direct : {DirectLight::hemisphere, DirectLight::cosine, DirectLight::surfaces})
        settings.push_back({.direct = direct});
    for (const Settings& s : settings) {
        SCOPED_TRACE(describe(s));
        const Estimates found =
            probe(scene, start, Technique::mis, {.samples = asks_lights(s) ? 4096u : 16384u, .bounces = 3, .direct = s});
        for (std::size_t i = 1; i <= 3; ++i) {
            const Statistic &a = found.terms[i], &b = plain.terms[i];
            EXPECT_NEAR(a.mean.r, b.mean.r, 4.5 * std::hypot(a.standard_error.r, b.standard_error.r)) << "bounce " << i;
            EXPECT_LT(a.standard_error.r, (asks_lights(s) ? 0.01 : 0.05) * a.mean.r) << "no power in bounce " << i;
        }
    }
}

// sample() tells the density that pdf() tells of what it has found, and that density has no more than 1 in all. The plain choice
// tells both with the same arithmetic, the others to rounding.
TEST(DirectStrategies, DensitiesAreThoseOfSamples) {
    SceneMaker maker = many_lights();
    maker.parts.lights.environment = ConstantEnvironment(Rgb(0.2));
    const Scene scene = maker.make();
    for (const LightChoice choice : choices)
        for (const LightPlace place : {LightPlace::area, LightPlace::solid_angle}) {
            const LightSampler lights(scene.geometry, scene.emitters, choice, place);
            Sampler sampler(fixed_seed, 0);
            for (std::uint64_t i = 0; i < 4000; ++i) {
                sampler.start(i);
                const Vec3 x(4.0 * sampler.next() - 2.0, 4.0 * sampler.next() - 2.0, 0.5 * sampler.next());
                const LightSample light = lights.sample(x, sampler.next2(), i % lights.asks());
                if (!(light.pdf > 0.0) || light.pdf == delta_pdf) continue;
                EXPECT_NEAR(lights.pdf(x, light.w, light.point) / light.pdf, 1.0, 1e-9) << static_cast<int>(choice) << i;
            }
        }
}

// Of a triangle, Girard's formula for an octant, and a small flat one.
TEST(DirectStrategies, SolidAngles) {
    EXPECT_NEAR(solid_angle({2, 0, 0}, {0, 3, 0}, {0, 0, 0.5}), 0.5 * pi, 1e-15);
    EXPECT_NEAR(solid_angle({0, 0, 1000}, {1, 0, 1000}, {0, 1, 1000}) / 0.5e-6, 1.0, 1e-5);
    EXPECT_EQ(solid_angle({1, 0, 0}, {2, 1, 0}, {2, -1, 0}), 0.0);
}

// Uniform in solid angle: the mean direction is half the sum of the sides' angles times their normals, over the solid angle
// (Stokes).
TEST(DirectStrategies, SphericalTrianglesAreSampledUniformly) {
    const auto side = [](const Vec3& p, const Vec3& q) {
        const Vec3 n = glm::cross(p, q);
        return n * (std::atan2(glm::length(n), glm::dot(p, q)) / glm::length(n));
    };
    for (const auto& [a, b, c] : {std::array{Vec3(-0.4, -0.3, 1), Vec3(0.9, -0.2, 1), Vec3(0.1, 0.7, 1)},
                                  std::array{Vec3(-0.4, -0.3, 0.05), Vec3(0.5, -0.3, 0.3), Vec3(0.1, 0.7, 0.1)}}) {
        const double angle = solid_angle(a, b, c);
        const Vec3 exact = (side(a, b) + side(b, c) + side(c, a)) * (0.5 / angle);
        Vec3 mean(0.0), squares(0.0);
        constexpr int n = 1 << 16;
        Sampler sampler(fixed_seed, 1);
        for (int i = 0; i < n; ++i) {
            sampler.start(static_cast<std::uint64_t>(i));
            const Vec3 w = sample_spherical_triangle(a, b, c, angle, sampler.next2());
            EXPECT_NEAR(glm::length(w), 1.0, 1e-12);
            mean += w / double(n);
            squares += w * w / double(n);
        }
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(mean[k], std::copysign(1.0, glm::dot(mean, exact)) * exact[k],
                        4.5 * std::sqrt((squares[k] - mean[k] * mean[k]) / n));
    }
}

// A face of a cube from its middle; from points of all kinds, flat ones among them, against the sum over the corners of
// ± atan(x y / (h r)), and against the sum of two triangles. At a height h rounding of the corners alone moves it by up to ε/h.
TEST(DirectStrategies, SolidAnglesOfRectangles) {
    EXPECT_NEAR(SphericalRectangle({-1, -1, 1}, {2, 0, 0}, {0, 2, 0}).solid_angle(), 4.0 * pi / 6.0, 1e-14);
    EXPECT_EQ(SphericalRectangle({1, -1, 0}, {2, 0, 0}, {0, 2, 0}).solid_angle(), 0.0);
    Sampler sampler(fixed_seed, 2);
    sampler.start(0);
    const auto number = [&] { return 4.0 * sampler.next() - 2.0; };
    for (int i = 0; i < 1000; ++i) {
        const double x = number(), y = number(), height = std::abs(number()) * std::pow(10.0, -(i % 6));
        const Vec3 corner(x, y, height), a(std::abs(number()), 0, 0), b(0, std::abs(number()), 0);
        const auto at_corner = [&](double s, double t) {
            return std::atan2(s * t, height * std::sqrt(s * s + t * t + height * height));
        };
        const double corners = at_corner(x + a.x, y + b.y) - at_corner(x, y + b.y) - at_corner(x + a.x, y) + at_corner(x, y);
        const double triangles = solid_angle(corner, corner + a, corner + b) + solid_angle(corner + a, corner + a + b, corner + b);
        const double found = SphericalRectangle(corner, a, b).solid_angle();
        EXPECT_NEAR(found, corners, 1e-14 / std::min(height, 1.0));
        EXPECT_NEAR(found, triangles, 1e-14 / std::min(height, 1.0));
    }
}

// χ² of 2^16 points in 16 × 16 cells of the rectangle, whose solid angles are those of rectangles. 4 comparisons, each with the
// false-alarm rate of |z| > 4.5, 6.8e-6.
TEST(DirectStrategies, SphericalRectanglesAreSampledUniformly) {
    constexpr int cells = 16, n = 1 << 16;
    for (const auto& [corner, a, b] : {std::array{Vec3(-0.4, -0.3, 1), Vec3(1.3, 0, 0), Vec3(0, 0.9, 0)},
                                       std::array{Vec3(0.5, 0.2, -0.4), Vec3(0, 2, 0), Vec3(0, 0, 0.7)},
                                       std::array{Vec3(0.3, -1.0, 0.02), Vec3(2, 0, 0), Vec3(0, 3, 0)},
                                       std::array{Vec3(-1, -1, 1e-3), Vec3(2, 0, 0), Vec3(0, 2, 0)}}) {
        const SphericalRectangle rectangle(corner, a, b);
        std::vector<double> found(cells * cells);
        Sampler sampler(fixed_seed, 3);
        for (int i = 0; i < n; ++i) {
            sampler.start(static_cast<std::uint64_t>(i));
            const Vec3 d = rectangle.sample(sampler.next2()) - corner;
            const int s = static_cast<int>(cells * glm::dot(d, a) / glm::dot(a, a)),
                      t = static_cast<int>(cells * glm::dot(d, b) / glm::dot(b, b));
            ++found[static_cast<std::size_t>(std::clamp(s, 0, cells - 1) * cells + std::clamp(t, 0, cells - 1))];
        }
        double chi2 = 0.0, rare_found = 0.0, rare = 0.0;  // cells of fewer than 10 expected points are joined
        int terms = 0;
        for (int s = 0; s < cells; ++s)
            for (int t = 0; t < cells; ++t) {
                const Vec3 part_a = a / double(cells), part_b = b / double(cells);
                const double expected =
                    n * SphericalRectangle(corner + double(s) * part_a + double(t) * part_b, part_a, part_b).solid_angle() /
                    rectangle.solid_angle();
                const double k = found[static_cast<std::size_t>(s * cells + t)];
                if (expected < 10.0) {
                    rare += expected;
                    rare_found += k;
                } else {
                    chi2 += (k - expected) * (k - expected) / expected;
                    ++terms;
                }
            }
        if (rare > 10.0) {
            chi2 += (rare_found - rare) * (rare_found - rare) / rare;
            ++terms;
        }
        ASSERT_GT(terms, 3);
        EXPECT_GT(boost::math::cdf(boost::math::complement(boost::math::chi_squared(terms - 1), chi2)), 6.8e-6);
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
