// One reflection of light from an area light: K^1 Le = ρ Le F, F the point-to-area form factor, known in closed form (Lambert 1760;
// Howell's catalogue of configuration factors). The figures were checked by tensor Gauss quadrature to 3e-14, spheres that cross
// the horizon to 3e-9.
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

namespace neumann::physics {
namespace {

constexpr double rho = 0.7, radiance = 3.0;

struct Receiver {
    Vec3 point, normal;
};

// A small receiving patch under a light, and K^1 Le there by all ways: to 0.2% by those that look for the light, to 0.5% by the
// others, which find a light of form factor F with probability F only, and to 2% where F is below 0.05.
void expect_direct(const Shape& light, const Receiver& receiver, double F, const std::string& what) {
    SceneMaker maker;
    maker.add(patch(receiver.point, receiver.normal, 0.01), matte(rho));
    maker.add(light, lamp(radiance));
    const Scene scene = maker.make();
    const StartPicker start = at(scene, receiver.point, receiver.normal);
    for (const Way way : {Way::mis, Way::light, Way::bsdf, Way::pointwise, Way::surfaces}) {
        SCOPED_TRACE(what + ", " + name(way));
        const double largest_error = looks_for_lights(way) ? power : F > 0.05 ? 0.005 : 0.02;
        const Estimates found = probe(scene, start, way, {.samples = 8192, .bounces = 2});
        expect_matches(found, std::vector{0.0, rho * radiance * F, 0.0}, 0, largest_error);
    }
}

TriangleMesh unit_square_above(double height) { return parallelogram({0, 0, height}, {0, 1, 0}, {1, 0, 0}); }

// 7 places × 5 ways: 35 comparisons.
TEST(DirectLightSlow, ARectangleLightsByLambertsFormula) {
    struct {
        Vec3 p;
        double F;
    } const cases[] = {{{0.5, 0.5, 0}, 0.23945647046077353883}, {{0, 0, 0}, 0.1385316059948930},
                       {{0.5, 0, 0}, 0.1803687411230800},       {{1.5, 0.5, 0}, 0.0843536643881085},
                       {{3, 0.5, 0}, 0.0065036076802058125},    {{2, 2, 0}, 0.011538711205309865}};
    for (const auto& [p, F] : cases) expect_direct(unit_square_above(1.0), {p, {0, 0, 1}}, F, "rectangle");
    expect_direct(unit_square_above(1.0), {{0.25, 0.5, 0}, {1, 0, 0}}, 0.05068846437775852, "rectangle cut by the horizon");
}

TEST(DirectLight, ATriangleLightsByLambertsFormula) {
    const Vec3 a(0.2, -0.4, 0.8), b(1.1, 0.3, 1.4), c(-0.3, 0.9, 1.0);
    TriangleMesh light = triangle(a, b, c);
    if (glm::dot(glm::cross(b - a, c - a), a) > 0.0) light = flipped(light);  // towards the origin
    expect_direct(light, {{0, 0, 0}, {0, 0, 1}}, 0.12491354786911968, "triangle");
}

// F = ½ [1 − (1 + H² − R²)/√(Z² − 4 R²)], H = h/a, R = r/a, Z = 1 + H² + R², at distance a from the axis.
TEST(DirectLight, ADiscLightsAParallelSurface) {
    const auto disc = [](double radius, double height) { return Disk{{0, 0, height}, {radius, 0, 0}, {0, radius, 0}, {0, 0, -1}}; };
    expect_direct(disc(0.5, 1.0), {{0, 0, 0}, {0, 0, 1}}, 0.2, "disc overhead");
    expect_direct(disc(0.5, 1.0), {{0.5, 0, 0}, {0, 0, 1}}, 0.1464466094067263, "disc, 0.5 aside");
    expect_direct(disc(0.5, 1.0), {{0, 2, 0}, {0, 0, 1}}, 0.0107251075066255, "disc, 2 aside");
    expect_direct(disc(1.0, 0.2), {{0.9, 0, 0}, {0, 0, 1}}, 0.6755617207941955, "large disc, below its rim");
}

// (R/d)² cosθ above the horizon; with s = R/d, c = cosθ, C = √(1 − s²) across it:
// (1/π) [s² c acos(−(c/√(1 − c²)) (C/s)) − C √(s² − c²) + atan(√(s² − c²)/C)].
TEST(DirectLight, ASphereLightsEvenFromPartlyBelowTheHorizon) {
    struct {
        double s, c, F;
    } const cases[] = {{0.5, 0.8, 0.2},
                       {0.5, 0.2, 0.0593458323558039},
                       {0.5, 0.0, 0.028834442811218716},
                       {0.5, -0.3, 0.003715430732647888},
                       {0.9, 0.1, 0.27331207396335966}};
    for (const auto& [s, c, F] : cases) {
        if (c < s) {
            const double C = std::sqrt(1 - s * s), q = std::sqrt(s * s - c * c);
            EXPECT_NEAR(F, (s * s * c * std::acos(-c / std::sqrt(1 - c * c) * C / s) - C * q + std::atan(q / C)) / pi, 1e-13);
        }
        const double sine = std::sqrt(1.0 - c * c);
        expect_direct(Sphere{{0.6 * sine, 0.8 * sine, c}, s, false}, {{0, 0, 0}, {0, 0, 1}}, F,
                      "sphere, cosine " + std::to_string(c));
    }
}

// Averages over the receiver: K^1 Le on average is ρ Le F12 between the two rectangles. 7 pairs × 2 or 3 ways: 19 comparisons.
// Where they touch, light sampling has infinite variance (∫ G² diverges) and is left out.
TEST(DirectLightSlow, BetweenRectanglesTheMeanIsTheFormFactor) {
    const auto horizontal = [](double x0, double x1, double y0, double y1, double z, bool up) {
        const TriangleMesh mesh = parallelogram({x0, y0, z}, {x1 - x0, 0, 0}, {0, y1 - y0, 0});
        return up ? mesh : flipped(mesh);
    };
    // In the plane x = 0, facing +x.
    const auto upright = [](double y0, double y1, double z0, double z1) {
        return parallelogram({0, y0, z0}, {0, y1 - y0, 0}, {0, 0, z1 - z0});
    };
    struct Pair {
        std::string what;
        TriangleMesh receiver, light;
        double F;
        bool touching;
    };
    const Pair pairs[] = {
        {"unit squares at distance 1", horizontal(0, 1, 0, 1, 0, true), horizontal(0, 1, 0, 1, 1, false), 0.19982489569838738304,
         false},
        {"unit squares at distance 0.5", horizontal(0, 1, 0, 1, 0, true), horizontal(0, 1, 0, 1, 0.5, false),
         0.41525328357714673537, false},
        {"2 × 1 at distance 1", horizontal(0, 2, 0, 1, 0, true), horizontal(0, 2, 0, 1, 1, false), 0.28587538485071471830, false},
        {"parallel, shifted", horizontal(0, 1, 0, 2, 0, true), horizontal(0.5, 2.5, -1, 0.25, 0.7, false), 0.08484343910717901,
         false},
        {"upright, apart", horizontal(0.2, 1, 0, 2, 0, true), upright(-1, 0.5, 0.1, 1.6), 0.08502766118381128, false},
        {"upright unit squares with a common edge", horizontal(0, 1, 0, 1, 0, true), upright(0, 1, 0, 1), 0.20004377607540315424,
         true},
        {"upright wall of height 2 on a unit square", horizontal(0, 1, 0, 1, 0, true), upright(0, 1, 0, 2), 0.23285260279536188805,
         true},
    };
    for (const Pair& pair : pairs) {
        SceneMaker maker;
        const std::uint32_t receiver = maker.add(pair.receiver, matte(rho));
        maker.add(pair.light, lamp(radiance));
        const Scene scene = maker.make();
        for (const Way way : {Way::mis, Way::bsdf, Way::light}) {
            if (pair.touching && way == Way::light) continue;
            SCOPED_TRACE(pair.what + ", " + name(way));
            expect_matches(
                probe(scene, anywhere_on(scene, receiver), way, {.samples = way == Way::bsdf ? 32768u : 8192u, .bounces = 2}),
                std::vector{0.0, rho * radiance * pair.F, 0.0}, 0, way == Way::bsdf ? 0.0025 : 0.002);
        }
    }
}

}  // namespace
}  // namespace neumann::physics
