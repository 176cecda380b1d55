// The irradiance on a shape, bounce by bounce.
#include "tests/physics/measured.h"

namespace neumann::physics::irradiance_meters_test {

const Method all_ways[] = {method::Walk(), method::Pointwise(), method::Light(), method::Bidirectional(), method::Gather()};

Scene with_meter(SceneMaker maker, std::uint32_t shape, const Film& film = one_pixel()) {
    maker.parts.camera = {.kind = SensorOptions::Kind::irradiance_meter, .shape = shape};
    maker.parts.film = film;
    return maker.make();
}

// E_i = π Le ρ^i on all that stands in a furnace, to rounding, where light is found by directions alone.
TEST(IrradianceMeters, InAFurnace) {
    constexpr double rho = 0.75, Le = 3.0;
    SceneMaker maker;
    maker.add(room({-1, -2, 0}, {2, 1, 1.5}), glowing(rho, Le));
    maker.add(Sphere{{0.3, -0.2, 0.6}, 0.3}, glowing(rho, Le));
    for (const std::uint32_t shape : {0u, 4u, 6u})
        for (const Method& method : {Method(method::Walk{{}, {DirectLight::bsdf}}), Method(method::Pointwise())}) {
            const BounceSeries found = measure(with_meter(maker, shape), method, 5, 1024);
            for (std::size_t i = 0; i <= 5; ++i) {
                const double exact = pi * Le * std::pow(rho, static_cast<double>(i));
                EXPECT_NEAR(found.term(i).mean.at(0, 0).r, exact, exact * 1e-14) << "shape " << shape << ", bounce " << i;
            }
        }
}

// π L under a sky that is the same everywhere, in all channels, from the front alone.
TEST(IrradianceMeters, UnderTheSky) {
    SceneMaker maker;
    const std::uint32_t square = maker.add(parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), matte(0.5)),
                        above = maker.add(parallelogram({0, 0, -0.1}, {1, 0, 0}, {0, 1, 0}), matte(0.5));
    maker.parts.lights.environment = ConstantEnvironment({1.0, 2.0, 3.0});
    const BounceSeries found = measure(with_meter(maker, square), method::Walk(), 2, 1024);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found.term(0).mean.at(0, 0)[c], pi * (c + 1.0), 1e-13);
    EXPECT_EQ(found.term(1).mean.at(0, 0), Rgb(0.0));
    // The lower one is nearly covered.
    EXPECT_LT(measure(with_meter(maker, above), method::Walk(), 0, 1024).term(0).mean.at(0, 0).r, 0.5 * pi);
}

// π L F between opposed unit squares at distance 1 (F as in first_bounce.cpp), and nothing after that, for the lamp is black. The
// meter's triangles are unequal, and only together the square. 5 comparisons.
TEST(IrradianceMetersSlow, UnderASquare) {
    constexpr double L = 3.0, F = 0.19982489569838738304;
    SceneMaker maker;
    const TriangleMesh uneven{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.2, 0.3, 0}},
                              {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
    const std::uint32_t meter = maker.add(uneven, matte(0.7));
    maker.add(parallelogram({0, 0, 1}, {0, 1, 0}, {1, 0, 0}), lamp(L));
    expect_measured(with_meter(maker, meter), all_ways, std::vector{pi * L * F, 0.0, 0.0}, 1 << 16, 0.015);
}

// Every pixel of a larger film measures the same, whatever filter it has. 2 methods of 12 pixels and 1 bounce.
TEST(IrradianceMetersSlow, AllPixelsAreAlike) {
    constexpr double L = 3.0, F = 0.19982489569838738304;
    SceneMaker maker;
    const std::uint32_t meter = maker.add(parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), matte(0.7));
    maker.add(parallelogram({0, 0, 1}, {0, 1, 0}, {1, 0, 0}), lamp(L));
    const Scene scene = with_meter(maker, meter, {5, 4, 1, 0, 4, 3, SignedFilter::lanczos()});
    for (const Method& method : {Method(method::Walk()), Method(method::Light())}) {
        const PixelEstimate found = measure(scene, method, 0, 1 << 12).term(0);
        for (std::size_t pixel = 0; pixel < 12; ++pixel)
            EXPECT_LE(std::abs(found.mean.pixels[pixel].r - pi * L * F), 4.5 * found.standard_error.pixels[pixel].r)
                << name_of(method) << ", pixel " << pixel;
    }
}

// A room with a lamp, a block and a ball on which the meter lies: all methods say the same. 5 comparisons of 4 bounces.
TEST(IrradianceMetersSlow, OfARoomByAllMethods) {
    SceneMaker maker;
    maker.add(room({-1, -1, 0}, {1, 1, 2}), matte(0.6));
    maker.add(parallelogram({-0.9, -0.9, 1.9}, {0, 1.8, 0}, {1.8, 0, 0}), lamp(5.0));
    maker.add(box({-0.8, -0.7, 0}, {-0.2, -0.1, 0.8}), matte(0.4));
    const std::uint32_t ball = maker.add(Sphere{{0.4, 0.3, 0.5}, 0.3}, matte(0.5));
    const Method methods[] = {method::Walk(),   method::Light(),     method::Bidirectional(),
                              method::Guided(), method::Corrected(), method::Gather()};
    expect_agreement(with_meter(maker, ball), methods, 3, 1 << 15, 0.05, 0.01);
}

// Of lights without extent bounce 0 holds nothing, which is said; bounce 1 does.
TEST(IrradianceMeters, MissLightsWithoutExtent) {
    SceneMaker maker;
    const std::uint32_t floor = maker.add(parallelogram({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), matte(0.6));
    maker.add(parallelogram({-1, -1, 1}, {0, 2, 0}, {2, 0, 0}), matte(0.6));
    maker.parts.lights.delta = {PointLight({0, 0, 0.5}, grey(1.0))};
    const Scene scene = with_meter(maker, floor);
    EXPECT_EQ(scene.warnings.counts(),
              (Warnings::Counts{{"sensor 'irradiancemeter' does not measure what comes straight from lights without extent "
                                 "(directional, directionalarea, point, projector, spot): bounce 0 is without it",
                                 1}}));
    const BounceSeries found = measure(scene, method::Walk(), 1, 1024);
    EXPECT_EQ(found.term(0).mean.at(0, 0), Rgb(0.0));
    EXPECT_GT(found.term(1).mean.at(0, 0).r, 0.0);
}

// The bounds are of irradiances.
TEST(IrradianceMeters, BoundsAreOfIrradiances) {
    SceneMaker maker;
    maker.add(room({0, 0, 0}, {1, 1, 1}), glowing(0.5, 3.0));
    const BounceSeries found = measure(with_meter(maker, 0), method::Walk(), 1, 64);
    EXPECT_NEAR(found.report.bounces[1].bound, pi * 3.0 * 0.25 / 0.5, 1e-12);  // Σ_{k>1} π Le ρ^k
}

}  // namespace neumann::physics::irradiance_meters_test
