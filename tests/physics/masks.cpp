// Holes and mixtures: deltas and smooth lobes in one material, whichever way lights are looked for.
#include "tests/physics/material_laws.h"
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

namespace neumann::physics::masks_test {

constexpr Technique ways[] = {Technique::mis, Technique::bsdf, Technique::light, Technique::pointwise};

std::shared_ptr<const Bsdf> shared(Bsdf bsdf) { return std::make_shared<const Bsdf>(std::move(bsdf)); }

// Panes that are not there are bounces all the same: a lamp behind m of them is K^m Le.
TEST(Null, EveryPaneIsABounce) {
    for (int m = 1; m <= 5; ++m) {
        SceneMaker maker;
        for (int k = 0; k < m; ++k) maker.add(patch({0, 0, -k}, {0.3, 0.2, k % 2 ? -1.0 : 1.0}, 1.0), boundary(Null(), Null()));
        maker.add(patch({0, 0, -m}, {0, 0, 1}, 1.0), lamp(2.0));
        const Scene scene = maker.make();
        for (const Technique way : ways) {
            SCOPED_TRACE(name(way) + ", panes: " + std::to_string(m));
            const StartPicker start = [p = surface_point(scene, {0, 0, 0}, glm::normalize(Vec3(0.3, 0.2, 1.0)))](Random&) {
                return Start{p, Vec3(0, 0, 1)};
            };
            expect_exact(probe(scene, start, way, {.samples = 16, .bounces = 6}), [m](int i) { return grey(i == m ? 2.0 : 0.0); });
        }
    }
}

// Half a pane: a disc of radius r at height h above it lights what is there, ρ r²/(r² + h²), and a lamp behind is seen through the
// holes. Both are K^1 Le: o ρ F L₁ + (1 − o) L₂. 3 opacities × 4 ways: 12 comparisons, pointwise to 1%.
TEST(Mask, HolesAndWhatIsBetweenThemAddUp) {
    const double rho = 0.7, r = 0.6, h = 0.8, F = r * r / (r * r + h * h);
    for (const double opacity : {0.25, 0.5, 0.9}) {
        SceneMaker maker;
        maker.add(patch({0, 0, 0}, {0, 0, 1}, 1.0),
                  boundary(Mask(shared(Diffuse(Rgb(rho))), Rgb(opacity)), Mask(nullptr, Rgb(opacity))));
        maker.add(Disk{{0, 0, h}, {r, 0, 0}, {0, r, 0}, {0, 0, -1}}, lamp(3.0));
        maker.add(patch({0, 0, -1}, {0, 0, 1}, 0.1), lamp(0.5));
        const Scene scene = maker.make();
        const double exact[] = {opacity * rho * F * 3.0 + (1.0 - opacity) * 0.5, 0.0};
        for (const Technique way : ways) {
            SCOPED_TRACE(name(way) + ", opacity " + std::to_string(opacity));
            expect_matches(probe(scene, at(scene, {0, 0, 0}, {0, 0, 1}), way, {.samples = 1024, .bounces = 2}), exact, 1, 0.003);
        }
    }
}

// Seen from its absorbing side, and in the light of the whole sky: K^1 Le = 1 − o, or o ρ + 1 − o from the other.
TEST(Mask, UnderTheSky) {
    const double rho = 0.7, opacity = 0.25;
    SceneMaker maker;
    maker.add(patch({0, 0, 0}, {0, 0, 1}, 1.0),
              boundary(Mask(shared(Diffuse(Rgb(rho))), Rgb(opacity)), Mask(nullptr, Rgb(opacity))));
    maker.parts.lights.environment = ConstantEnvironment(Rgb(1.0));
    const Scene scene = maker.make();
    for (const Technique way : ways)
        for (const double side : {1.0, -1.0}) {
            SCOPED_TRACE(name(way));
            const double exact[] = {(side > 0.0 ? opacity * rho : 0.0) + 1.0 - opacity, 0.0};
            const auto start = at(scene, {0.1, 0.2, 0}, {0, 0, side});
            expect_matches(probe(scene, start, way, {.samples = 512, .bounces = 2}), exact, 1);
        }
}

TEST(Mask, ItsBoundsHold) {
    const auto half = shared(Diffuse(Rgb(0.2, 0.4, 0.6)));
    EXPECT_EQ(largest_albedo(Mask(half, Rgb(0.5))), Rgb(0.6, 0.7, 0.8));
    EXPECT_EQ(largest_albedo(Mask(nullptr, Rgb(0.25))), Rgb(0.75));
    const SurfaceFunction varying([](const ShadingPoint& p) { return Rgb(texture_coordinates(p).x); }, Rgb(1.0));
    EXPECT_EQ(largest_albedo(Mask(half, varying)), Rgb(1.0));
    EXPECT_TRUE(needs_coordinates(Mask(half, varying)));
    EXPECT_FALSE(is_constant(Mask(half, varying)));
    EXPECT_TRUE(transmits(Mask(half, Rgb(0.5))));
    EXPECT_EQ(lobe(Mask(half, Rgb(0.5))).kind, Lobe::Kind::specular);
    const auto glass = shared(Dielectric(0.5));
    EXPECT_EQ(largest_albedo(Mask(glass, Rgb(0.5))), Rgb(2.5));
    EXPECT_EQ(largest_basic_albedo(Mask(glass, Rgb(0.5))), Rgb(1.0));
}

// A sphere of part mirror, part matt surface, seen from inside at the angle of cosine μ. A chord has the same angle at both ends,
// so with Le = μ², K^i Le = ρs^i (μ² − ½) + (ρs + ρd)^i/2. ρs = 0.3, ρd = 0.5, μ = 0.1: the figures are those of the formula. 4
// ways × 5 bounces: 20 comparisons, to 0.6%.
TEST(Blend, AMirrorAndAMattSurfaceMixAsOne) {
    SceneMaker maker;
    const Blend mixed(shared(Conductor({}, Rgb(0.75))), shared(Diffuse(Rgb(0.5 / 0.6))), Rgb(0.6));
    maker.add(Sphere{{0, 0, 0}, 1.0, true}, made_of(mixed, AreaLight(
                                                               [](const ShadingPoint& p, const Vec3& w) {
                                                                   const double mu = glm::dot(p.frame.n, w);
                                                                   return Rgb(mu * mu);
                                                               },
                                                               Rgb(1.0))));
    const Scene scene = maker.make();
    const double exact[] = {0.01, 0.253, 0.2759, 0.24277, 0.200831, 0.1626493};
    const SurfacePoint p = surface_point(scene, {0, 0, -1}, {0, 0, 1});
    const StartPicker start = [p](Random&) { return Start{p, at_cosine(0.1)}; };
    for (const Technique way : ways) {
        SCOPED_TRACE(name(way));
        expect_matches(probe(scene, start, way, {.samples = 512, .bounces = 5}), exact, 0, 0.006);
    }
}

// Two that overlap have one density; the furnace in a sphere has K^i Le = albedo^i at the first bounce only, so the law of
// largest_albedo is by quadrature.
TEST(Blend, OverlappingLobesHaveOneDensity) {
    const auto rough = shared(RoughConductor(Ggx(0.3), {}, Rgb(0.9, 0.6, 0.3))), matt = shared(Diffuse(Rgb(0.2, 0.5, 0.8)));
    std::uint32_t stream = 100;
    for (const double weight : {0.0, 0.3, 1.0}) {
        const Bsdf bsdf = Blend(rough, matt, Rgb(weight));
        for (const double mu : {1.0, 0.5, 0.1}) {
            expect_consistent_samples(bsdf, {}, at_cosine(mu));
            for (int c = 0; c < 3; ++c) {
                const double mixed = (1.0 - weight) * albedo(*rough, mu, c, 1e-7) + weight * albedo(*matt, mu, c, 1e-7);
                EXPECT_NEAR(albedo(bsdf, mu, c, 1e-7), mixed, 1e-5);
                EXPECT_LE(mixed, largest_albedo(bsdf)[c] + 1e-9);
            }
        }
        EXPECT_GE(directions_p_value(bsdf, {}, at_cosine(0.5), stream++), 6.8e-6);
        EXPECT_LE(largest_irreciprocity(bsdf, {}), 1e-10);
    }
    const Lobe both = lobe(Blend(matt, rough, Rgb(0.5)));
    EXPECT_EQ(both.kind, Lobe::Kind::rough);
    EXPECT_EQ(both.alpha, 0.3);
    EXPECT_EQ(lobe(Blend(shared(Conductor()), rough, Rgb(0.5))).kind, Lobe::Kind::specular);
}

// Two matt materials are a matt one.
TEST(Blend, OfMattMaterialsIsMatt) {
    const SurfaceFunction weight([](const ShadingPoint& p) { return Rgb(texture_coordinates(p).x); }, Rgb(0.75));
    const auto dark = shared(Diffuse(Rgb(0.2))), light = shared(Diffuse(Rgb(0.6, 0.7, 0.8)));
    const Bsdf bsdf = Blend(dark, light, weight);
    const ShadingPoint p = point_with_coordinates({0.5, 0.0});
    EXPECT_EQ(lobe(bsdf).kind, Lobe::Kind::diffuse);
    EXPECT_TRUE(factors(bsdf));
    EXPECT_FALSE(transmits(bsdf));
    EXPECT_NEAR(glm::length(reflectance(bsdf, p) - Rgb(0.4, 0.45, 0.5)), 0.0, 1e-15);
    EXPECT_NEAR(glm::length(eval(bsdf, p, at_cosine(0.3), at_cosine(0.6)) - reflectance(bsdf, p) * inv_pi), 0.0, 1e-15);
    EXPECT_NEAR(glm::length(largest_albedo(bsdf) - Rgb(0.5, 0.575, 0.65)), 0.0, 1e-15);
    EXPECT_NEAR(glm::length(eval(white(bsdf), p, at_cosine(0.3), at_cosine(0.6)) - Rgb(inv_pi)), 0.0, 1e-15);
    EXPECT_NEAR(reflectance(Blend(nullptr, light, weight), p).b, 0.4, 1e-15);
    // A rough one does not factor where the share varies.
    EXPECT_FALSE(factors(Blend(dark, shared(RoughConductor(Ggx(0.3))), weight)));
    EXPECT_TRUE(factors(Blend(dark, shared(RoughConductor(Ggx(0.3))), Rgb(0.4))));
}

// K = ρ T, and T² = I in a closed room: K^2 Le = ρ² Le at the same place, in between ρ Le of where the ray comes from.
TEST(Retroreflector, SendsLightBackWhereItCameFrom) {
    const double rho = 0.9;
    SceneMaker maker;
    for (const TriangleMesh& face : room({0, 0, 0}, {1, 1, 1}))
        maker.add(face, made_of(Retroreflector(Rgb(rho)),
                                AreaLight([](const ShadingPoint& p, const Vec3&) { return p.position; }, Rgb(1.0))));
    const Scene scene = maker.make();
    const Vec3 d = glm::normalize(Vec3(1.0, 0.7, 0.45));
    SurfacePoint here, there;
    ASSERT_TRUE(scene.geometry.first_hit({0.3, 0.4, 0.5}, d, 1e9, here));
    ASSERT_TRUE(scene.geometry.first_hit({0.3, 0.4, 0.5}, -d, 1e9, there));
    for (const Technique way : ways) {
        SCOPED_TRACE(name(way));
        const Estimates found = probe(scene,
                                      [&](Random&) {
                                          return Start{here, -d};
                                      },
                                      way, {.samples = 2, .bounces = way == Technique::pointwise ? 10 : 40});
        for (std::size_t i = 0; i < found.terms.size(); ++i)
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(found.terms[i].mean[c], std::pow(rho, i) * (i % 2 ? there : here).position[c], 1e-12) << i;
                EXPECT_EQ(found.terms[i].standard_error[c], 0.0);
            }
    }
}

TEST(Retroreflector, ARoughOneIsARoughMirrorTurnedRound) {
    std::uint32_t stream = 200;
    for (const double alpha : {0.2, 0.6}) {
        const Bsdf bsdf = RoughRetroreflector(Ggx(alpha), Rgb(0.8, 0.5, 0.2)), mirror = RoughConductor(Ggx(alpha), {}, Rgb(0.8));
        for (const double mu : {1.0, 0.6, 0.2}) {
            const Vec3 wo = at_cosine(mu);
            EXPECT_GE(directions_p_value(bsdf, {}, wo, stream++), 6.8e-6);
            expect_consistent_samples(bsdf, {}, wo);
            EXPECT_NEAR(albedo(bsdf, mu, 0, 1e-8), albedo(mirror, mu, 0, 1e-8), 1e-6);
            // Brightest along ωo, give or take the facets' masking.
            EXPECT_GT(eval(bsdf, {}, wo, wo).r, eval(bsdf, {}, wo, Vec3(-wo.x, -wo.y, wo.z)).r * (mu < 1.0 ? 1.0 : 0.999));
        }
        EXPECT_LE(largest_irreciprocity(bsdf, {}), 1e-10);
        EXPECT_EQ(largest_albedo(bsdf), Rgb(0.8, 0.5, 0.2));
    }
}

}  // namespace neumann::physics::masks_test
