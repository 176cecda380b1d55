// Metals whose facets are rougher along one tangent than along the other, and metals whose roughness varies.
#include "core/base/frame.h"
#include "tests/physics/material_laws.h"

#include <algorithm>

namespace neumann::physics::anisotropic_metals_test {

const ConductorFresnel gold(Rgb(0.143, 0.374, 1.442), Rgb(3.983, 2.385, 1.603));

struct Named {
    std::string name;
    Bsdf bsdf;
    Vec2 alpha;
};
std::vector<Named> metals() {
    std::vector<Named> all;
    for (const Vec2 alpha : {Vec2(0.1, 0.4), Vec2(0.8, 0.3)})
        for (const Masking masking : {Masking::separable, Masking::height_correlated}) {
            const std::string text = ", alpha " + std::to_string(alpha.x) + " and " + std::to_string(alpha.y);
            all.push_back({"GGX" + text, RoughConductor(Ggx(alpha), gold, Rgb(1.0, 0.9, 0.8), masking), alpha});
            all.push_back({"Beckmann" + text, RoughConductor(Beckmann(alpha), gold, Rgb(1.0, 0.9, 0.8), masking), alpha});
        }
    return all;
}
// Views of several azimuths.
Vec3 view(double mu, double phi) {
    const double sine = std::sqrt(1.0 - mu * mu);
    return {sine * std::cos(phi), sine * std::sin(phi), mu};
}
const Vec3 views[] = {view(1.0, 0.0), view(0.7, 0.0), view(0.7, 1.0), view(0.3, 2.5), view(0.1, 4.4)};

// ∫ D(m) m.z dm = 1, and ∫ D(m) (v·m)⁺ dm is the projected area; over slopes s = m.xy/m.z, whose density is D m.z⁴.
TEST(AnisotropicFacets, CoverTheSurfaceAndTheView) {
    const auto check = [](const auto& facets, const Vec2& alpha) {
        for (const Vec3& v : views) {
            double surface = 0.0, seen = 0.0;
            constexpr int rings = 400, sectors = 128;
            for (int i = 0; i < rings; ++i)
                for (int j = 0; j < sectors; ++j) {
                    const double q = (i + 0.5) / rings, r = q / (1.0 - q), phi = 2.0 * pi * (j + 0.5) / sectors;
                    const Vec3 m = glm::normalize(Vec3(alpha.x * r * std::cos(phi), alpha.y * r * std::sin(phi), 1.0));
                    const double dm =
                        alpha.x * alpha.y * r / ((1.0 - q) * (1.0 - q)) * m.z * m.z * m.z * 2.0 * pi / (rings * sectors);
                    surface += facets.density(m) * m.z * dm;
                    seen += facets.density(m) * std::max(glm::dot(v, m), 0.0) * dm;
                }
            EXPECT_NEAR(surface, 1.0, 1e-3);
            EXPECT_NEAR(seen / facets.projected_area(v), 1.0, 1e-3);
        }
    };
    for (const Vec2 alpha : {Vec2(0.1, 0.4), Vec2(0.8, 0.3)}) {
        check(Ggx(alpha), alpha);
        check(Beckmann(alpha), alpha);
    }
}

// 8 metals × 5 views: 40 comparisons, each with the false-alarm rate of |z| > 4.5, 6.8e-6.
TEST(AnisotropicMetal, DirectionsAreDrawnWithTheirDensity) {
    std::uint32_t stream = 100;
    for (const auto& [name, bsdf, alpha] : metals())
        for (const Vec3& wo : views) EXPECT_GE(directions_p_value(bsdf, {}, wo, stream++), 6.8e-6) << name << ", z " << wo.z;
}

TEST(AnisotropicMetal, TheWeightTimesTheDensityIsTheScatteringFunction) {
    for (const auto& [name, bsdf, alpha] : metals()) {
        SCOPED_TRACE(name);
        for (const Vec3& wo : views) expect_consistent_samples(bsdf, {}, wo);
    }
}

TEST(AnisotropicMetal, IsReciprocal) {
    for (const auto& [name, bsdf, alpha] : metals()) EXPECT_LE(largest_irreciprocity(bsdf, {}), 1e-10) << name;
}

TEST(AnisotropicMetal, ReflectsNoMoreThanItsBound) {
    for (const auto& [name, bsdf, alpha] : metals())
        for (const Vec3& wo : views)
            for (int c = 0; c < 3; ++c) {
                const double found = albedo_of_both_sides(bsdf, wo, c);
                EXPECT_GT(found, 0.0);
                EXPECT_LE(found, largest_albedo(bsdf)[c] * (1.0 + 1e-3)) << name;
            }
}

// A quarter turn exchanges the tangents; with both alike it is the metal that knows no tangents.
TEST(AnisotropicMetal, TurnsWithItsTangents) {
    const auto turned = [](const Vec3& w) { return Vec3(-w.y, w.x, w.z); };
    const Bsdf one = RoughConductor(Ggx(Vec2(0.1, 0.4)), gold), other = RoughConductor(Ggx(Vec2(0.4, 0.1)), gold);
    for (const Vec3& a : views)
        for (const Vec3& b : views) {
            const double exact = eval(one, {}, a, b).g;
            EXPECT_NEAR(eval(other, {}, turned(a), turned(b)).g, exact, 1e-12 * exact);
        }
    EXPECT_TRUE(needs_coordinates(one));
    EXPECT_TRUE(is_constant(one));
    EXPECT_FALSE(needs_coordinates(Bsdf(RoughConductor(Ggx(Vec2(0.4)), gold))));
    EXPECT_EQ(lobe(one).alpha, 0.1);
}

TEST(VaryingRoughness, IsThatOfThePoint) {
    const SurfaceFunction u([](const ShadingPoint& p) { return Rgb(0.1 + texture_coordinates(p).x); }, Rgb(1.1));
    const SurfaceFunction v([](const ShadingPoint& p) { return Rgb(texture_coordinates(p).y); }, Rgb(1.0));
    const Bsdf bsdf = RoughConductor<Beckmann>(Roughness<Beckmann>(u, v), gold);
    ShadingPoint p = point_with_coordinates({0.2, 0.5});
    const Bsdf here = RoughConductor(Beckmann(Vec2(0.1 + 0.2, 0.5)), gold);
    const Vec3 wo = views[2], wi = views[3];
    EXPECT_EQ(eval(bsdf, p, wo, wi), eval(here, {}, wo, wi));
    EXPECT_EQ(pdf(bsdf, p, wo, wi), pdf(here, {}, wo, wi));
    EXPECT_EQ(sample(bsdf, p, wo, Vec2(0.3, 0.6)).wi, sample(here, {}, wo, Vec2(0.3, 0.6)).wi);
    p = point_with_coordinates({0.2, 0.0});
    EXPECT_EQ(eval(bsdf, p, wo, wi), eval(Bsdf(RoughConductor(Beckmann(Vec2(0.1 + 0.2, 1e-4)), gold)), {}, wo, wi));
    EXPECT_TRUE(needs_coordinates(bsdf));
    EXPECT_FALSE(is_constant(bsdf));
}

}  // namespace neumann::physics::anisotropic_metals_test
