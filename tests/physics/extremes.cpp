// Odd scenes with plain answers.
#include "core/sampling/warp.h"
#include "operators/known/pictures.h"
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

namespace neumann::physics {
namespace {

constexpr Way all_ways[] = {Way::mis, Way::bsdf, Way::light, Way::pointwise, Way::surfaces};

// The form factor from a point to a parallel rectangle a × b centred at height h above it: four times that of a corner,
// 1/(2π) [A/√(1 + A²) atan(B/√(1 + A²)) + B/√(1 + B²) atan(A/√(1 + B²))], A = a/2h, B = b/2h.
double rectangle_overhead(double a, double b, double h) {
    const double A = 0.5 * a / h, B = 0.5 * b / h, p = std::sqrt(1.0 + A * A), q = std::sqrt(1.0 + B * B);
    return 2.0 / pi * (A / p * std::atan(B / p) + B / q * std::atan(A / q));
}

// A lamp cut into 2, 4, 8 or 64 strips gives the same light, also where the strips are needles: 20 × 0.01 cut along, aspect 1 :
// 128000. 2 lamps × 5 × 2 ways: 20 comparisons.
TEST(Extremes, ALampCutIntoPiecesGivesTheSameLight) {
    struct {
        Vec3 across, along;
    } const lamps[] = {{{0, 1, 0}, {1, 0, 0}}, {{0, 0.01, 0}, {20, 0, 0}}};
    for (const auto& [across, along] : lamps)
        for (const int pieces : {1, 2, 4, 8, 64}) {
            SceneMaker maker;
            maker.add(patch({0, 0, 0}, {0, 0, 1}, 0.01), matte(0.5));
            maker.add(strips(Vec3(0, 0, 1) - 0.5 * (across + along), across, along, pieces), lamp(2.0));
            const Scene scene = maker.make();
            const double exact = 0.5 * 2.0 * rectangle_overhead(glm::length(along), glm::length(across), 1.0);
            for (const Way way : {Way::mis, Way::light}) {
                SCOPED_TRACE(name(way) + ", " + std::to_string(pieces) + " pieces, length " + std::to_string(along.x));
                expect_matches(probe(scene, at(scene, {0, 0, 0}, {0, 0, 1}), way, {.samples = 16384, .bounces = 1}),
                               std::vector{0.0, exact});
            }
        }
}

// The same for what receives: the floor of the cube with a glowing ceiling, cut into needles. K^1 and K^2 at the floor's centre. 6
// comparisons.
TEST(Extremes, AFloorCutIntoPiecesReflectsTheSame) {
    for (const int pieces : {2, 8, 1024}) {
        SceneMaker maker;
        const auto faces = room({0, 0, 0}, {1, 1, 1});
        for (std::size_t i = 0; i < 6; ++i)
            maker.add(i == floor ? strips({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, pieces) : faces[i],
                      i == ceiling ? glowing(0.8, 1.0) : matte(0.8));
        const Scene scene = maker.make();
        expect_matches(probe(scene, at(scene, {0.5, 0.5, 0}, {0, 0, 1}), Way::mis, {.samples = 8192, .bounces = 3}),
                       std::vector{0.8 * 0.23945647046077306, 0.64 * 0.13875246294508298, 0.512 * 0.18030273351449316}, 1);
    }
}

// A lamp of side s with Le s² kept: K^1 Le = ρ Le s² cosθ cosθ'/(π r²) (1 + O(s²/r²)), in a room and at its centre, wherever the
// receiver is. Seen from a metre it is a point, and the float rays that ask for it are not that exact. 4 sizes × 2 ways × 2 shapes.
TEST(Extremes, ATinyLampIsAPointLight) {
    const double rho = 0.5;
    const Vec3 p(0.6, -0.5, -1.0);
    const double r2 = glm::dot(p, p), cosine = 1.0 / std::sqrt(r2);
    for (const double s : {1e-2, 1e-4, 1e-6, 1e-9})
        for (const bool sphere : {false, true}) {
            SceneMaker maker;
            maker.add(flipped(box({-1, -1, -1}, {1, 1, 1})), matte(rho));
            // A sphere of diameter s looks the same from everywhere: π s²/4 of area across.
            if (sphere)
                maker.add(Sphere{{0, 0, 0}, 0.5 * s, false}, lamp(1.0 / (s * s)));
            else
                maker.add(patch({0, 0, 0}, {0, 0, -1}, 0.5 * s), lamp(1.0 / (s * s)));
            const Scene scene = maker.make();
            const double exact = rho * cosine * (sphere ? 0.25 * pi : cosine) / (pi * r2);
            for (const Way way : {Way::mis, Way::light}) {
                SCOPED_TRACE(name(way) + ", s = " + std::to_string(s) + (sphere ? ", sphere" : ", square"));
                const Statistic found = probe(scene, at(scene, p, {0, 0, 1}), way, {.samples = 4096, .bounces = 1}).terms[1];
                EXPECT_LE(std::abs(found.mean.r / exact - 1.0), z_limit * found.standard_error.r / exact + s * s / r2 + 1e-12);
                EXPECT_LE(found.standard_error.r, power * exact);
            }
        }
}

// What lies twice in the same place reflects once.
TEST(Extremes, AFloorThatIsThereTwiceReflectsOnce) {
    const auto lit = [](int copies) {
        SceneMaker maker;
        const auto faces = room({0, 0, 0}, {1, 1, 1});
        for (std::size_t i = 0; i < 6; ++i)
            for (int k = 0; k < (i == floor ? copies : 1); ++k) maker.add(faces[i], i == ceiling ? glowing(0.8, 1.0) : matte(0.8));
        const Scene scene = maker.make();
        return probe(scene, at(scene, {0.2, 0.3, 0}, {0, 0, 1}), Way::mis, {.samples = 256, .bounces = 6});
    };
    const Estimates once = lit(1), twice = lit(2);
    for (std::size_t i = 0; i < once.terms.size(); ++i)
        EXPECT_EQ(once.terms[i].mean.r, twice.terms[i].mean.r) << "K^" << i << " Le";
}

// A surface seen from behind is black: it neither shines nor reflects, and it hides what is beyond.
TEST(Extremes, FromBehindASurfaceIsBlack) {
    SceneMaker maker;
    const std::uint32_t glowing_floor = maker.add(parallelogram({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), glowing(0.8, 1.0));
    maker.add(parallelogram({-9, -9, -2}, {18, 0, 0}, {0, 18, 0}), glowing(0.5, 3.0));
    const Scene scene = maker.make();
    const SurfacePoint p = surface_point(scene, {0.2, 0.1, 0}, {0, 0, -1});
    ASSERT_EQ(p.shape, glowing_floor);
    const Vec3 down(0, 0.6, -0.8);
    for (const Way way : all_ways) {
        SCOPED_TRACE(name(way));
        const Estimates found = probe(scene,
                                      [=](Random&) {
                                          return Start{p, down};
                                      },
                                      way, {.samples = 16, .bounces = 3, .rest_probability = 1.0});
        for (const Statistic& term : found.terms) expect_matches(term, 0.0, "light from a back side");
        expect_matches(found.rest, 0.0, "rest");
    }
    // The lower floor sees the upper one's back only: what it reflects is nothing.
    for (const Way way : all_ways) {
        SCOPED_TRACE(name(way));
        const Estimates found = probe(scene, at(scene, {0, 0, -2}, {0, 0, 1}), way, {.samples = 256, .bounces = 3});
        expect_matches(found, std::vector{3.0, 0.0, 0.0, 0.0});
    }
}

// Degenerate triangles and lights without area are left out, counted, and change no bit.
TEST(Extremes, WhatHasNoAreaIsNotThere) {
    const auto room_with = [](bool rubbish) {
        SceneMaker maker;
        auto faces = room({0, 0, 0}, {1, 1, 1});
        if (rubbish) faces[floor].triangles.insert(faces[floor].triangles.end(), {{0, 0, 1}, {1, 1, 1}, {0, 3, 3}});
        for (std::size_t i = 0; i < 6; ++i) maker.add(faces[i], i == ceiling ? glowing(0.8, 1.0) : matte(0.8));
        if (rubbish) {
            maker.add(triangle({0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}, {0.4, 0.4, 0.4}), lamp(1e6));
            maker.add(Sphere{{0.5, 0.5, 0.5}, 0.0, false}, lamp(1e6));
            maker.add(Disk{{0.5, 0.5, 0.5}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}}, lamp(1e6));
            maker.add(TriangleMesh{}, lamp(1e6));
        }
        return maker.make();
    };
    const Scene clean = room_with(false), littered = room_with(true);
    EXPECT_EQ(littered.warnings.counts().at("degenerate triangle or shape without extent left out"), 6u);
    EXPECT_EQ(littered.warnings.counts().at("light without area gives off nothing"), 4u);
    for (const Way way : {Way::mis, Way::bsdf, Way::pointwise}) {
        const Effort effort{.samples = 64, .bounces = 6};
        const Estimates one = probe(clean, at(clean, {0.3, 0.4, 0}, {0, 0, 1}), way, effort);
        const Estimates other = probe(littered, at(littered, {0.3, 0.4, 0}, {0, 0, 1}), way, effort);
        for (std::size_t i = 0; i < one.terms.size(); ++i) {
            EXPECT_EQ(one.terms[i].mean.r, other.terms[i].mean.r) << name(way) << ", K^" << i << " Le";
            EXPECT_EQ(one.terms[i].standard_error.r, other.terms[i].standard_error.r) << name(way) << ", K^" << i << " Le";
        }
    }
}

// Only a light without area, only a black room, no surfaces at all: zeros, with finite statistics.
TEST(Extremes, WithoutLightOrSurfacesAllIsZero) {
    for (int kind = 0; kind < 3; ++kind) {
        SceneMaker maker;
        maker.parts.camera.fov = 1.0;
        maker.parts.film = {4, 4, 0, 0, 4, 4};
        if (kind > 0) maker.add(make_cube(Mat4(1.0), true), matte(0.9));
        if (kind > 1) maker.add(triangle({0, 0, 0.5}, {0, 0.1, 0.5}, {0, 0.2, 0.5}), lamp(1.0));
        const Scene scene = maker.make();
        EXPECT_FALSE(scene.warnings.counts().empty());
        for (const DirectLight direct : {DirectLight::mis, DirectLight::light, DirectLight::bsdf}) {
            PictureSampler::Settings settings;
            settings.walk = {.bounces = 4, .direct = {direct}};
            const Pictures pictures = render(scene, settings, 4);
            for (std::size_t q = 0; q < pictures.result.quantities(); ++q)
                for (const Estimate& e : {pictures.result.term(q), pictures.result.sum(q)})
                    for (std::size_t i = 0; i < e.mean.pixels.size(); ++i) {
                        EXPECT_TRUE(is_black(e.mean.pixels[i]));
                        EXPECT_TRUE(is_black(e.standard_error.pixels[i]));
                    }
            EXPECT_EQ(pictures.tally.non_finite_samples(), 0u);
        }
    }
}

}  // namespace
}  // namespace neumann::physics
