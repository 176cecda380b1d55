// Smooth boundaries that let light through: Fresnel's and Snell's laws. The terms of slabs, panes and glass spheres are in
// operators/experiments/known/glass.cpp, rough boundaries in rough_dielectrics.cpp, holes in masks.cpp.
#include "operators/experiments/known/quadrature.h"
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neumann::physics::dielectrics_test {

constexpr Technique ways[] = {Technique::mis, Technique::bsdf, Technique::light, Technique::pointwise};
constexpr double n = 1.5;

Surface glass(double eta = n) { return boundary(Dielectric(eta), Dielectric(1.0 / eta)); }

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

TEST(ThinDielectric, AFurnaceSeesAllOfTheLight) {
    SceneMaker maker;
    maker.add(patch({0, 0, 0}, {0, 0, 1}, 1.0), boundary(ThinDielectric(1.0 / n), ThinDielectric(1.0 / n)));
    maker.parts.lights.environment = ConstantEnvironment(Rgb(1.0));
    const Scene scene = maker.make();
    for (const Technique way : ways)
        for (const double x : {0.1, 3.0})
            expect_exact(probe(scene, seen(scene, {-x, 0.1, -1}, {x, 0, 1}), way, {.samples = 16, .bounces = 3}),
                         [](int i) { return grey(i == 1 ? 1.0 : 0.0); });
}

}  // namespace neumann::physics::dielectrics_test
