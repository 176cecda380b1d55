// Light by a picture of all directions: where its pixels are, its density, and what it lights.
#include "core/emitter/environment_map.h"
#include "core/image/display.h"
#include "core/sampling/sampler.h"
#include "operators/experiments/known/quadrature.h"
#include "tests/physics/cell_counts.h"
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

namespace neumann::physics::environment_maps_test {

// Numbers without any pattern; some pixels are black, and one is 100 times as bright as the others.
Image picture(int width, int height) {
    Image image(width, height);
    Sampler sampler(5, static_cast<std::uint32_t>(width));
    sampler.start(0);
    for (Rgb& c : image.pixels) c = sampler.next() < 0.3 ? Rgb(0.0) : Rgb(sampler.next(), sampler.next(), sampler.next());
    image.at(width - 1, height / 2) = {90.0, 100.0, 80.0};
    return image;
}

// Light at the first and the last row only: at the poles, where sinθ is 0.
Image poles() {
    Image image(4, 5);
    for (int x = 0; x < 4; ++x) image.at(x, 0) = image.at(x, 4) = Rgb(1.0 + x);
    return image;
}

const Mat4 upright(1.0), skew = glm::rotate(Mat4(1.0), 0.7, glm::normalize(Vec3(3, -1, 2)));

Vec3 towards(double phi, double theta) {
    return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

// ∫∫ f(ω) sinθ dθ dφ over a part of the sphere, in pieces that end where the map's cells do: f is smooth within each.
template <class Function>
double over_cells(int width, int height, const Function& f, double phi_from = 0.0, double phi_to = 1.0, double theta_from = 0.0,
                  double theta_to = 1.0) {
    using Gauss = boost::math::quadrature::gauss<double, 10>;
    const auto edges = [](double from, double to, int pieces) {
        std::vector<double> all{from};
        for (int i = 1; i < pieces; ++i)
            if (static_cast<double>(i) / pieces > from && static_cast<double>(i) / pieces < to)
                all.push_back(static_cast<double>(i) / pieces);
        all.push_back(to);
        return all;
    };
    double sum = 0.0;
    // Pixels' middles and edges, so that multiples of a right angle are among them as well.
    const std::vector<double> columns = edges(phi_from, phi_to, 2 * width), rows = edges(theta_from, theta_to, height - 1);
    for (std::size_t i = 0; i + 1 < columns.size(); ++i)
        for (std::size_t j = 0; j + 1 < rows.size(); ++j)
            sum += Gauss::integrate(
                [&](double theta) {
                    return std::sin(theta) * Gauss::integrate([&](double phi) { return f(phi, theta); }, 2.0 * pi * columns[i],
                                                              2.0 * pi * columns[i + 1]);
                },
                pi * rows[j], pi * rows[j + 1]);
    return sum;
}

// Mitsuba's convention: +y is up, the middle of the picture is at +z, its left quarter at +x.
TEST(EnvironmentMap, PixelsLieWhereMitsubaHasThem) {
    const int width = 8, height = 5;
    const Image image = picture(width, height);
    const EnvironmentMap map(image, 2.0, upright);
    const auto expect = [&](const Vec3& w, const Rgb& radiance) {
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(map.radiance(w)[c], radiance[c], 1e-12 * (1.0 + radiance[c]));
    };
    for (int y = 1; y + 1 < height; ++y)
        for (int x = 0; x < width; ++x) expect(towards(2.0 * pi * (x + 0.5) / width, pi * y / (height - 1)), 2.0 * image.at(x, y));
    // The middle of the row θ = π/2 is between the fourth and the fifth pixel; the seam, at −z, between the last and the first.
    expect({0, 0, 1}, image.at(3, 2) + image.at(4, 2));
    expect({1, 0, 0}, image.at(1, 2) + image.at(2, 2));
    expect({-1, 0, 0}, image.at(5, 2) + image.at(6, 2));
    expect({0, 0, -1}, image.at(7, 2) + image.at(0, 2));
    EXPECT_EQ(map.largest(), Rgb(180.0, 200.0, 160.0));
    EXPECT_FALSE(map.is_grey());
    EXPECT_TRUE(EnvironmentMap(poles(), 1.0, upright).is_grey());
}

TEST(EnvironmentMap, ToWorldTurnsIt) {
    const Image image = picture(8, 5);
    const Mat4 mirrored = glm::scale(skew, Vec3(-1, 1, 1));
    const EnvironmentMap map(image, 1.0, upright);
    Sampler sampler(fixed_seed, 0);
    for (const Mat4& to_world : {skew, mirrored}) {
        const EnvironmentMap turned(image, 1.0, to_world);
        for (std::uint64_t i = 0; i < 100; ++i) {
            sampler.start(i);
            const Vec3 w = uniform_sphere(sampler.next2()), there = Vec3(to_world * glm::dvec4(w, 0.0));
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(turned.radiance(there)[c], map.radiance(w)[c], 1e-9);
            EXPECT_NEAR(turned.pdf(there), map.pdf(w), 1e-9);
        }
    }
}

struct Case {
    const char* name;
    Image image;
};
std::vector<Case> cases() {
    return {{"8 × 5", picture(8, 5)}, {"7 × 6", picture(7, 6)}, {"2 × 3", picture(2, 3)}, {"poles", poles()}};
}

// In each cell pdf · sinθ is a polynomial, which the rule integrates exactly.
TEST(EnvironmentMap, TheDensityIntegratesToOne) {
    for (const auto& [name, image] : cases()) {
        const EnvironmentMap map(image, 3.0, upright);
        EXPECT_NEAR(over_cells(image.width, image.height, [&](double phi, double theta) { return map.pdf(towards(phi, theta)); }),
                    1.0, 1e-11)
            << name;
    }
}

// The quotient is ∫ Y s / (Y s / sinθ), the same everywhere but for s / sinθ, which is between 1 − (spacing of rows)²/8 and 1, and
// 1 at rows. At the poles it has a finite limit.
TEST(EnvironmentMap, TheDensityFollowsTheLuminance) {
    for (const auto& [name, image] : cases()) {
        const EnvironmentMap map(image, 3.0, upright);
        const double spacing = pi / (image.height - 1), total = 4.0 * pi * map.brightness();
        Sampler sampler(fixed_seed, 1);
        for (std::uint64_t i = 0; i < 1000; ++i) {
            sampler.start(i);
            const Vec3 w = i == 0 ? Vec3(0, 1, 0) : i == 1 ? Vec3(0, -1, 0) : uniform_sphere(sampler.next2());
            const double Y = luminance(map.radiance(w)), pdf = map.pdf(w);
            if (Y == 0.0) {
                EXPECT_EQ(pdf, 0.0) << name;
                continue;
            }
            EXPECT_LE(pdf * total / Y, 1.0 + 1e-12) << name;
            EXPECT_GE(pdf * total / Y, 1.0 - spacing * spacing / 6.0 - (image.height == 3 ? 0.2 : 0.0)) << name;
        }
    }
}

// χ² of 131072 directions in 16 × 24 cells. 4 maps, each with the false-alarm rate of |z| > 4.5, 6.8e-6.
TEST(EnvironmentMap, DirectionsAreDrawnWithTheirDensity) {
    constexpr int rings = 16, sectors = 24, count = 131072;
    std::uint32_t stream = 0;
    for (const auto& [name, image] : cases()) {
        const EnvironmentMap map(image, 1.0, upright);
        std::vector<double> found(rings * sectors);
        Sampler sampler(fixed_seed, stream++);
        for (int i = 0; i < count; ++i) {
            sampler.start(static_cast<std::uint64_t>(i));
            const Vec3 w = map.sample(sampler.next2());
            EXPECT_NEAR(glm::length(w), 1.0, 1e-11);
            const double turn = std::atan2(w.x, -w.z) / (2.0 * pi);
            const int ring = std::min(static_cast<int>(std::acos(std::clamp(w.y, -1.0, 1.0)) / pi * rings), rings - 1);
            const int sector = std::min(static_cast<int>((turn < 0.0 ? turn + 1.0 : turn) * sectors), sectors - 1);
            found[static_cast<std::size_t>(ring * sectors + sector)] += 1.0;
        }
        CellCounts cells;
        for (int ring = 0; ring < rings; ++ring)
            for (int sector = 0; sector < sectors; ++sector) {
                const double expected =
                    count * over_cells(
                                image.width, image.height, [&](double phi, double theta) { return map.pdf(towards(phi, theta)); },
                                static_cast<double>(sector) / sectors, (sector + 1.0) / sectors, static_cast<double>(ring) / rings,
                                (ring + 1.0) / rings);
                cells.add(found[static_cast<std::size_t>(ring * sectors + sector)], expected);
            }
        EXPECT_NEAR(cells.few_found, cells.few_expected, 4.5 * std::sqrt(cells.few_expected) + 1e-9) << name;
        EXPECT_GE(cells.p(), 6.8e-6) << name << ": χ² = " << cells.chi2 << " in " << cells.cells << " cells";
    }
}

// K^1 Le = ρ/π ∫ L cosθ dω, by quadrature of the map; and over a sphere, on which all normals are alike, ρ/4π ∫ L dω on average. 4
// places × 3 ways: 12 comparisons.
TEST(EnvironmentMapSlow, LightsASurfaceByItsIntegral) {
    const double rho = 0.7;
    const int width = 8, height = 5;
    const EnvironmentMap map(picture(width, height), 1.5, upright);
    const auto integral = [&](const auto& weight) {
        return over_cells(width, height, [&](double phi, double theta) {
            const Vec3 w = towards(phi, theta);
            return map.radiance(w).r * weight(w);
        });
    };
    SceneMaker maker;
    maker.parts.lights.environment = map;
    const std::uint32_t ball = maker.add(Sphere{{0, 0, 0}, 1.0, false}, matte(rho));
    const Scene scene = maker.make();
    for (const Technique way : {Technique::mis, Technique::light, Technique::bsdf}) {
        SCOPED_TRACE(name(way));
        // By chance the brightest pixel is found rarely.
        const double largest_error = way == Technique::bsdf ? 0.02 : power;
        for (const Vec3& n : {Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, -1)}) {
            const double exact = rho / pi * integral([&](const Vec3& w) { return std::max(glm::dot(n, w), 0.0); });
            expect_matches(probe(scene, at(scene, n, n), way, {.samples = 8192, .bounces = 2}), std::vector{0.0, exact, 0.0}, 0,
                           largest_error);
        }
        expect_matches(probe(scene, anywhere_on(scene, ball), way, {.samples = 4096, .bounces = 1}),
                       std::vector{0.0, rho / (4.0 * pi) * integral([](const Vec3&) { return 1.0; })}, 0, largest_error);
    }
}

// A map without light is none.
TEST(EnvironmentMap, MayBeBlack) {
    SceneMaker maker;
    maker.parts.lights.environment = EnvironmentMap(Image(4, 3), 1.0, upright);
    maker.add(Sphere{{0, 0, 0}, 1.0, false}, matte(0.5));
    const Scene scene = maker.make();
    EXPECT_TRUE(scene.emitters.empty());
    for (const Technique way : {Technique::mis, Technique::light, Technique::bsdf})
        expect_exact(probe(scene, at(scene, {0, 0, 1}, {0, 0, 1}), way, {.samples = 64, .bounces = 2}),
                     [](int) { return grey(0.0); });
}

}  // namespace neumann::physics::environment_maps_test
