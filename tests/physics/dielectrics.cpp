// Smooth boundaries that let light through: Fresnel's and Snell's laws, and the terms of slabs, panes and glass spheres, which are
// known one by one. Rough ones are in rough_dielectrics.cpp, holes in masks.cpp.
#include "operators/known/quadrature.h"
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neumann::physics {
namespace {

constexpr Way ways[] = {Way::mis, Way::bsdf, Way::light, Way::pointwise};
constexpr double n = 1.5;

Surface glass(double eta = n) { return boundary(Dielectric(eta), Dielectric(1.0 / eta)); }

// What is seen from `origin` along `direction`.
StartPicker seen(const Scene& scene, const Vec3& origin, const Vec3& direction) {
    const Vec3 d = glm::normalize(direction);
    SurfacePoint p;
    if (!scene.geometry.first_hit(origin, d, 1e9, p)) throw std::logic_error("there is no surface here");
    return [start = Start{p, -d}](Random&) { return start; };
}

// Light goes the same way in both directions: F is the same from both sides. Beyond the critical angle it is 1.
TEST(DielectricFresnel, IsTheSameFromBothSides) {
    for (const double eta : {1.0003, 1.33, 1.5, 2.419, 4.0})
        for (const double outside : {1.0, 0.9, 0.5, 0.1, 1e-3}) {
            const double inside = std::sqrt(1.0 - (1.0 - outside * outside) / (eta * eta));
            const double F = conductor_fresnel(outside, eta, 0.0);
            EXPECT_NEAR(conductor_fresnel(inside, 1.0 / eta, 0.0), F, 1e-9 * F) << eta << " " << outside;
        }
    const double critical = std::sqrt(1.0 - 1.0 / (n * n));
    for (const double cosine : {0.9999 * critical, 0.5 * critical, 1e-9}) EXPECT_EQ(conductor_fresnel(cosine, 1.0 / n, 0.0), 1.0);
    EXPECT_LT(conductor_fresnel(1.0001 * critical, 1.0 / n, 0.0), 0.97);
}

// Brewster's angle, tan θ = n: only the half that is polarised across is reflected, ((n² − 1)/(n² + 1))².
TEST(DielectricFresnel, HasBrewstersAngle) {
    for (const double eta : {1.33, 1.5, 2.419}) {
        const double s = (eta * eta - 1.0) / (eta * eta + 1.0);
        EXPECT_NEAR(conductor_fresnel(1.0 / std::sqrt(1.0 + eta * eta), eta, 0.0), 0.5 * s * s, 1e-14);
    }
}

// The mean inside, 1 − (1 − F̄)/n² with F̄ = 0.0917779593423512 outside (Walsh's closed form): 0.596345759707712.
TEST(DielectricFresnel, HasTheCosineAverageOfGlassFromInside) {
    const double critical = std::sqrt(1.0 - 1.0 / (n * n));
    // μ² = μc² + (1 − μc²) s⁴, for F has a root's edge at the critical angle.
    const double beyond = critical * critical;
    const double partly = integrate_smooth(0.0, 1.0, [&](double s) {
        const double s3 = s * s * s, mu = std::sqrt(beyond + (1.0 - beyond) * s3 * s);
        return conductor_fresnel(mu, 1.0 / n, 0.0) * (1.0 - beyond) * 4.0 * s3;
    });
    EXPECT_NEAR(beyond + partly, 0.596345759707712, 1e-11);
}

TEST(Dielectric, ReflectsAndRefractsByFresnelsAndSnellsLaws) {
    for (const double eta : {n, 1.0 / n, 1.0, 2.419})
        for (const double mu : {1.0, 0.9, 0.5, 0.1, 1e-6}) {
            const Bsdf bsdf = Dielectric(eta, Rgb(0.9, 0.8, 0.7), Rgb(0.6, 0.5, 0.4));
            const double sine = std::sqrt(1.0 - mu * mu);
            const Vec3 wo(0.6 * sine, 0.8 * sine, mu);
            const double F = conductor_fresnel(mu, eta, 0.0);
            if (F > 1e-9) {
                const BsdfSample reflected = sample(bsdf, {}, wo, {F * (1.0 - 1e-12), 0.3});
                EXPECT_EQ(reflected.wi, Vec3(-wo.x, -wo.y, wo.z));
                EXPECT_EQ(reflected.weight, Rgb(0.9, 0.8, 0.7));
                EXPECT_EQ(reflected.pdf, delta_pdf);
            }
            if (sine >= eta) {
                EXPECT_EQ(F, 1.0);
                continue;
            }
            const BsdfSample refracted = sample(bsdf, {}, wo, {F * (1.0 + 1e-12), 0.3});
            EXPECT_LT(refracted.wi.z, 0.0);
            EXPECT_NEAR(glm::length(refracted.wi), 1.0, 1e-14);
            EXPECT_NEAR(refracted.wi.x * eta, -wo.x, 1e-14);
            EXPECT_NEAR(refracted.wi.y * eta, -wo.y, 1e-14);
            EXPECT_NEAR(glm::length(refracted.weight * eta * eta - Rgb(0.6, 0.5, 0.4)), 0.0, 1e-14);
            EXPECT_EQ(refracted.pdf, delta_pdf);
            // From the other side the light comes back the same way, and radiance is what it was.
            const Bsdf other = Dielectric(1.0 / eta);
            const BsdfSample back = sample(other, {}, -refracted.wi, {1.0 - 1e-9, 0.3});
            EXPECT_NEAR(glm::length(back.wi + wo), 0.0, 1e-9 / std::max(mu, 1e-3));
            EXPECT_NEAR(back.weight.r / (eta * eta), 1.0, 1e-14);
        }
}

TEST(Dielectric, StaysWithinItsBounds) {
    for (const double eta : {n, 1.0 / n})
        for (const double mu : {1.0, 0.5, 0.01})
            for (const double u : {0.0, 0.999999}) {
                const Bsdf bsdf = Dielectric(eta, Rgb(0.9), Rgb(0.8));
                const BsdfSample found = sample(bsdf, {}, at_cosine(mu), {u, 0.5});
                EXPECT_LE(found.weight.r, largest_albedo(bsdf).r);
                EXPECT_EQ(largest_basic_albedo(bsdf), Rgb(0.9));
                EXPECT_TRUE(transmits(bsdf));
                EXPECT_EQ(lobe(bsdf).kind, Lobe::Kind::specular);
            }
    EXPECT_EQ(largest_albedo(Dielectric(0.5, Rgb(0.9), Rgb(0.8))), Rgb(3.2));
    SceneMaker maker;
    maker.add(Sphere{{0, 0, 0}, 1.0, false}, glass());
    maker.parts.lights.environment = ConstantEnvironment(Rgb(1.0));
    const Scene scene = maker.make();
    EXPECT_TRUE(scene.warnings.counts().empty()) << scene.warnings.counts().begin()->first;
}

// Numbers are independent here: a Sobol' set has always as many points below R, and no spread to tell the error by.
//
// A slab under a sky of radiance 1: K^1 Le = R, K^i Le = (1 − R)² R^(i−2). All of the light comes back, walk by walk. With the
// unpolarised mean at each boundary; R is that of the angle. 4 ways × 2 angles × 5 bounces: 40 comparisons, to 2.5%.
TEST(Dielectric, ASlabHasAGeometricSeries) {
    SceneMaker maker;
    maker.add(parallelogram({-90, -90, 0.5}, {180, 0, 0}, {0, 180, 0}), glass());
    maker.add(parallelogram({-90, -90, -0.5}, {0, 180, 0}, {180, 0, 0}), glass());
    maker.parts.lights.environment = ConstantEnvironment(Rgb(1.0));
    const Scene scene = maker.make();
    for (const auto& [degrees, R] : {std::pair{80.0, 0.387704354691}, {60.0, 0.089186712802}}) {
        const double theta = degrees * pi / 180.0;
        std::vector<double> exact = {R};
        for (int i = 2; i <= 5; ++i) exact.push_back((1.0 - R) * (1.0 - R) * std::pow(R, i - 2));
        if (degrees == 60.0) exact.resize(3);
        for (const Way way : ways) {
            SCOPED_TRACE(name(way) + ", " + std::to_string(degrees) + "°");
            const auto start = seen(scene, {0.01, 0.02, 3}, {std::sin(theta), 0, -std::cos(theta)});
            expect_matches(probe(scene, start, way,
                                 {.samples = 2048, .bounces = static_cast<int>(exact.size()), .sampler = SamplerKind::independent}),
                           exact, 1, 0.03);
            if (way == Way::pointwise) continue;
            const Estimates all = probe(scene, start, way, {.samples = 64, .bounces = 60});
            EXPECT_NEAR(all.reflected.mean.r, 1.0, 1e-12);
            EXPECT_LE(all.reflected.standard_error.r, 1e-12);
        }
    }
}

// Inside a glass sphere the angle stays the same, so the same series holds for every ray; seen from outside, at the impact
// parameter b = sin θ. Seen from inside it is K^i Le = n² (1 − R) R^(i−1), and 0 beyond the critical angle. 4 ways × (5 + 3)
// bounces: 32 comparisons, to 2.5%.
TEST(Dielectric, AGlassSphereHasTheSameSeries) {
    SceneMaker maker;
    maker.add(Sphere{{0.1, 0.2, 0.3}, 1.0, false}, glass());
    maker.parts.lights.environment = ConstantEnvironment(Rgb(1.0));
    const Scene scene = maker.make();
    const Vec3 center(0.1, 0.2, 0.3);
    const double theta = 80.0 * pi / 180.0, R = 0.387704354691;
    std::vector<double> outside = {R}, inside;
    for (int i = 2; i <= 5; ++i) outside.push_back((1.0 - R) * (1.0 - R) * std::pow(R, i - 2));
    for (int i = 1; i <= 3; ++i) inside.push_back(n * n * (1.0 - R) * std::pow(R, i - 1));
    for (const Way way : ways) {
        SCOPED_TRACE(name(way));
        const auto from_outside = seen(scene, center + Vec3(-3.0, std::sin(theta), 0), {1, 0, 0});
        expect_matches(probe(scene, from_outside, way, {.samples = 2048, .bounces = 5, .sampler = SamplerKind::independent}),
                       outside, 1, 0.03);
        // A ray inside at the distance b from the centre meets the surface at the angle of sine b.
        const auto from_inside = [&](double b) { return seen(scene, center + Vec3(0, b, 0), {1, 0, 0}); };
        expect_matches(probe(scene, from_inside(std::sin(theta) / n), way,
                             {.samples = 2048, .bounces = 3, .sampler = SamplerKind::independent}),
                       inside, 1, 0.03);
        const Estimates trapped = probe(scene, from_inside(0.7), way, {.samples = 2, .bounces = way == Way::pointwise ? 12 : 100});
        for (std::size_t i = 0; i < trapped.terms.size(); ++i) EXPECT_TRUE(is_black(trapped.terms[i].mean)) << i;
        if (way == Way::pointwise) continue;
        const Estimates all = probe(scene, from_outside, way, {.samples = 64, .bounces = 60});
        EXPECT_NEAR(all.reflected.mean.r, 1.0, 1e-12);
        EXPECT_LE(all.reflected.standard_error.r, 1e-12);
    }
}

// A diffuse floor of reflectance ρ under a slab: the slab is one surface that the light has to pass twice on its way to the sky.
// With r the share that the slab reflects, averaged over directions from below, and light that leaves through it,
// Σ K^i Le of the furnace is 1 for ρ = 1, whatever is between. Seen through the slab at 80°; 64 bounces hold all but 10⁻⁴.
TEST(Dielectric, AFurnaceWithGlassInItIsStillAFurnace) {
    SceneMaker maker;
    maker.add(Sphere{{0, 0, 0}, 2.0, true}, glowing(0.5, 0.5));
    maker.add(Sphere{{0.3, 0.1, 0}, 0.7, false}, glass());
    maker.add(make_cube(glm::dmat4(0.3, 0, 0, 0, 0, 0.3, 0, 0, 0, 0, 0.3, 0, -0.9, 0.1, 0.2, 1)), glass(1.33));
    const Scene scene = maker.make();
    for (const Way way : {Way::mis, Way::bsdf, Way::light}) {
        SCOPED_TRACE(name(way));
        // Le = 1 − ρ on a wall of reflectance ρ gives L = 1, and n² within glass.
        const Estimates found =
            probe(scene, seen(scene, {-0.2, -1.2, 0.4}, {0.5, 1.3, -0.4}), way, {.samples = 1024, .bounces = 80});
        const Rgb total = found.reflected.mean;
        EXPECT_NEAR(total.r, 1.0, std::max(4.5 * found.reflected.standard_error.r, 1e-12));
        EXPECT_LE(found.reflected.standard_error.r, 0.003);
    }
}

// With what goes to and fro inside added up, a pane reflects 2R/(1 + R): 0.163767537 at 60°. Nothing turns, so a lamp behind is
// seen where it is. 4 ways × 2: 8 comparisons.
TEST(ThinDielectric, ReflectsAsASlab) {
    const double theta = pi / 3.0, R = 0.089186712802;
    EXPECT_NEAR(2.0 * R / (1.0 + R), 0.163767537, 1e-9);
    for (const bool behind : {true, false}) {
        SceneMaker maker;
        maker.add(patch({0, 0, 0}, {0, 0, 1}, 1.0), boundary(ThinDielectric(n), ThinDielectric(n)));
        const Vec3 towards(std::sin(theta), 0, behind ? -std::cos(theta) : std::cos(theta));
        maker.add(patch(2.0 * towards, -towards, 0.1), lamp(2.0));
        const Scene scene = maker.make();
        for (const Way way : ways) {
            SCOPED_TRACE(name(way));
            const auto start = seen(scene, {-std::sin(theta), 0, std::cos(theta)}, {std::sin(theta), 0, -std::cos(theta)});
            const Estimates found = probe(scene, start, way, {.samples = 4096, .bounces = 2});
            const double share = behind ? 1.0 - 2.0 * R / (1.0 + R) : 2.0 * R / (1.0 + R);
            expect_matches(found, std::vector<double>{0.0, 2.0 * share, 0.0}, 0, 0.006);
        }
    }
}

TEST(ThinDielectric, AFurnaceSeesAllOfTheLight) {
    SceneMaker maker;
    maker.add(patch({0, 0, 0}, {0, 0, 1}, 1.0), boundary(ThinDielectric(1.0 / n), ThinDielectric(1.0 / n)));
    maker.parts.lights.environment = ConstantEnvironment(Rgb(1.0));
    const Scene scene = maker.make();
    for (const Way way : ways)
        for (const double x : {0.1, 3.0})
            expect_exact(probe(scene, seen(scene, {-x, 0.1, -1}, {x, 0, 1}), way, {.samples = 16, .bounces = 3}),
                         [](int i) { return grey(i == 1 ? 1.0 : 0.0); });
}

}  // namespace
}  // namespace neumann::physics
