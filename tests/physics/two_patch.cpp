// Two surfaces that each see themselves and the other evenly: radiosity with a 2 × 2 matrix is exact,
//
//     K = [ρ1 F11  ρ1 F12; ρ2 F21  ρ2 F22],
//
// and its values are the same all over each surface, up to the rim where they meet.
//     concentric spheres, inner seen from outside:  F12 = 1,  F21 = (r1/r2)²,  F22 = 1 − F21;
//     a chamber of a sphere closed by a disc, with the fraction f of the sphere's area:  F_dd = 0, F_ds = 1, F_sd = 1 − f, F_ss =
//     f.
// One eigenvalue is negative, so the terms alternate.
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

namespace neumann::physics {
namespace {

struct TwoPatch {
    double rho[2], F[2][2];

    // K^i Le on both surfaces, i = 0 … count − 1.
    std::array<std::vector<double>, 2> terms(double Le0, double Le1, int count) const {
        double a = Le0, b = Le1;
        std::array<std::vector<double>, 2> result;
        for (int i = 0; i < count; ++i) {
            result[0].push_back(a);
            result[1].push_back(b);
            const double next_a = rho[0] * (F[0][0] * a + F[0][1] * b), next_b = rho[1] * (F[1][0] * a + F[1][1] * b);
            a = next_a;
            b = next_b;
        }
        return result;
    }
};

Surface maybe_glowing(double rho, double Le) { return Le > 0.0 ? glowing(rho, Le) : matte(rho); }

// The figures of the dome (ρ 0.7 on the disc, 0.5 on the hemisphere, the disc emits) in full, as a check of the formula.
TEST(TwoPatch, TheDomeHasTheSequenceOfItsMatrix) {
    const auto terms = TwoPatch{{0.7, 0.5}, {{0, 1}, {0.5, 0.5}}}.terms(1, 0, 7);
    const double disc[] = {1, 0, 0.175, 0.04375, 0.0415625, 0.018046875, 0.01178515625};
    const double hemisphere[] = {0, 0.25, 0.0625, 0.059375, 0.02578125, 0.0168359375, 0.008720703125};
    for (std::size_t i = 0; i < 7; ++i) {
        EXPECT_NEAR(terms[0][i], disc[i], 1e-16);
        EXPECT_NEAR(terms[1][i], hemisphere[i], 1e-16);
    }
}

// 3 chambers × 2 emitters × 2 ways × 5 places × up to 7 terms, to 1%: 378 comparisons.
TEST(TwoPatchSlow, AChamberOfASphereIsEvenUpToItsRim) {
    for (const double f : {0.5, 0.75, 0.25})
        for (const bool disc_glows : {true, false}) {
            // The chamber is above the plane z = 1 − 2 f; the part of the sphere below is shut off by the disc's black back.
            const double rho_disc = 0.7, rho_sphere = 0.5, height = 1.0 - 2.0 * f, rim = std::sqrt(1.0 - height * height);
            SceneMaker maker;
            maker.add(Disk{{0, 0, height}, {rim, 0, 0}, {0, rim, 0}, {0, 0, 1}}, maybe_glowing(rho_disc, disc_glows));
            maker.add(Sphere{{0, 0, 0}, 1.0, true}, maybe_glowing(rho_sphere, !disc_glows));
            const Scene scene = maker.make();
            const auto exact = TwoPatch{{rho_disc, rho_sphere}, {{0, 1}, {1 - f, f}}}.terms(disc_glows, !disc_glows, 7);

            const auto on_disc = [&](double r) { return at(scene, {r * 0.6, r * 0.8, height}, {0, 0, 1}, 1e-5); };
            const auto on_sphere = [&](double z) {
                const Vec3 n(0.6 * std::sqrt(1.0 - z * z), 0.8 * std::sqrt(1.0 - z * z), z);
                return at(scene, n, -n, 1e-5);
            };
            for (const Way way : {Way::mis, Way::bsdf}) {
                const Effort effort{.samples = 2048, .bounces = 6};
                for (const double r : {0.0, rim - 1e-3}) {
                    SCOPED_TRACE(name(way) + ", f = " + std::to_string(f) + ", disc, radius " + std::to_string(r));
                    expect_matches(probe(scene, on_disc(r), way, effort), exact[0], 0, 0.01);
                }
                for (const double z : {1.0, 0.5 * (1.0 + height), height + 1e-4}) {
                    SCOPED_TRACE(name(way) + ", f = " + std::to_string(f) + ", sphere, z = " + std::to_string(z));
                    expect_matches(probe(scene, on_sphere(z), way, effort), exact[1], 0, 0.01);
                }
            }
        }
}

// Radii 0.99 and 1 are almost parallel plates: eigenvalues 0.9 and −0.88209. 2 ways × 2 places × 13 terms, to 0.4%: 48 comparisons
// and 4 zeros.
TEST(TwoPatchSlow, ConcentricSpheresThrowTheLightToAndFro) {
    const double c = 0.99, F21 = c * c;
    SceneMaker maker;
    maker.add(Sphere{{0, 0, 0}, c, false}, glowing(0.9, 1.0));
    maker.add(Sphere{{0, 0, 0}, 1.0, true}, matte(0.9));
    const Scene scene = maker.make();
    const auto exact = TwoPatch{{0.9, 0.9}, {{0, 1}, {F21, 1 - F21}}}.terms(1, 0, 13);
    EXPECT_NEAR(exact[1][3], 0.7005574376233291, 1e-15);
    const Vec3 n(0.48, 0.64, 0.6);
    for (const Way way : {Way::mis, Way::bsdf}) {
        SCOPED_TRACE(name(way));
        const Effort effort{.samples = 8192, .bounces = 12};
        expect_matches(probe(scene, at(scene, n * c, n), way, effort), exact[0], 0, 0.004);
        expect_matches(probe(scene, at(scene, n, -n), way, effort), exact[1], 0, 0.004);
    }
}

// Far apart they are a lamp in a room: r1/r2 = 1/3. Light sampling has finite variance here. 3 ways × 2 places × 7 terms, to 0.4%:
// 36 comparisons and 6 zeros.
TEST(TwoPatchSlow, ASphereInASphereIsLitEvenly) {
    const double F21 = 1.0 / 9.0;
    SceneMaker maker;
    maker.add(Sphere{{1, 2, 3}, 1.0, false}, glowing(0.4, 1.0));
    maker.add(Sphere{{1, 2, 3}, 3.0, true}, matte(0.8));
    const Scene scene = maker.make();
    const auto exact = TwoPatch{{0.4, 0.8}, {{0, 1}, {F21, 1 - F21}}}.terms(1, 0, 7);
    const Vec3 n(-0.48, 0.64, 0.6);
    for (const Way way : {Way::mis, Way::bsdf, Way::light}) {
        SCOPED_TRACE(name(way));
        const Effort effort{.samples = 8192, .bounces = 6};
        expect_matches(probe(scene, at(scene, Vec3(1, 2, 3) + n, n), way, effort), exact[0], 0, 0.004);
        expect_matches(probe(scene, at(scene, Vec3(1, 2, 3) + n * 3.0, -n), way, effort), exact[1], 0, 0.004);
    }
}

}  // namespace
}  // namespace neumann::physics
