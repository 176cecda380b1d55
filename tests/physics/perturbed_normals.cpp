// Normal and bump maps: the nested material around another normal.
#include "core/sampling/sampler.h"
#include "operators/experiments/known/quadrature.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neumann::physics::perturbed_normals_test {

constexpr PerturbedNormal::Options plain{false, false, false};

Bsdf perturbed(const Bsdf& nested, const Vec3& normal, const PerturbedNormal::Options& options = plain) {
    return PerturbedNormal([normal](const ShadingPoint&) { return normal; }, std::make_shared<const Bsdf>(nested), options);
}
Vec3 direction(double theta, double phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}
// ∫ f(ω) |cosθ| dω over the upper hemisphere, cut where the perturbed hemisphere with the normal (sinτ, 0, cosτ) ends.
template <class Function>
double over_directions(double tilt, const Function& f) {
    return integrate_smooth(-pi, pi, [&](double phi) {
        const double cosine = std::cos(phi) * std::tan(tilt);
        const double edge = cosine < 0.0 ? std::atan2(1.0, -cosine) : 0.5 * pi;
        const auto ring = [&](double theta) { return f(direction(theta, phi)) * std::cos(theta) * std::sin(theta); };
        return integrate_smooth(0.0, edge, ring) + (edge < 0.5 * pi ? integrate_smooth(edge, 0.5 * pi, ring) : 0.0);
    });
}

// n' = (−∂f/∂x, −∂f/∂y, 1) over a plane with the height f, whatever the coordinates on it: by the chain rule.
TEST(PerturbedNormals, BumpsOfAHeightField) {
    const Vec2 gradient(0.7, -1.3);
    for (const auto& [du, dv] : {std::pair(Vec3(2, 0, 0), Vec3(0, 3, 0)), std::pair(Vec3(2, 0, 0), Vec3(1, 3, 0)),
                                 std::pair(Vec3(0, -1, 0), Vec3(0.2, 0.1, 0)), std::pair(Vec3(1, 0, 0), Vec3(0, -1, 0))}) {
        for (const bool front : {true, false}) {
            const Shape triangle = TriangleMesh{{{0, 0, 0}, du, dv}, {{0, 1, 2}}};
            ShadingPoint p = shading_point(triangle, {{0, 0, 0}, {0, 0, 1}});
            const Vec3 s = p.frame.s;
            if (!front) p.frame = p.frame.other_side();
            const Vec3 n = bump_normal(p, {gradient.x * du.x + gradient.y * du.y, gradient.x * dv.x + gradient.y * dv.y});
            const Vec3 found = glm::normalize(s * n.x + p.frame.t * n.y + Vec3(0, 0, 1) * n.z);
            EXPECT_NEAR(glm::length(found - glm::normalize(Vec3(-gradient, 1.0))), 0.0, 1e-15);
        }
    }
}

TEST(PerturbedNormals, AMapWithoutPerturbationChangesNothing) {
    const Bsdf rough = RoughConductor(Ggx(0.3)), same = perturbed(rough, {0, 0, 2}, {});
    const Vec3 wo = direction(0.8, 0.3), wi = direction(1.1, 2.0);
    EXPECT_NEAR(eval(same, {}, wo, wi).r, eval(rough, {}, wo, wi).r, 1e-14);
    EXPECT_NEAR(pdf(same, {}, wo, wi), pdf(rough, {}, wo, wi), 1e-14);
    const BsdfSample a = sample(same, {}, wo, {0.2, 0.7}), b = sample(rough, {}, wo, {0.2, 0.7});
    EXPECT_NEAR(glm::length(a.wi - b.wi), 0.0, 1e-14);
    EXPECT_NEAR(a.weight.r, b.weight.r, 1e-14);
}

TEST(PerturbedNormals, MirrorsReflectAboutTheNewNormal) {
    const Vec3 n = glm::normalize(Vec3(0.3, -0.2, 1.0)), wo = direction(0.5, 1.0);
    EXPECT_NEAR(glm::length(sample(perturbed(Conductor(), n), {}, wo, {}).wi - (2.0 * glm::dot(n, wo) * n - wo)), 0.0, 1e-15);
    const Vec3 behind(n.x * -1.0, n.y * -1.0, n.z);
    EXPECT_NEAR(glm::length(sample(perturbed(Conductor(), n, {false, false, true}), {}, wo, {}).wi -
                            (2.0 * glm::dot(behind, wo) * behind - wo)),
                0.0, 1e-15);
    // Into the surface: nothing.
    EXPECT_EQ(sample(perturbed(Conductor(), direction(1.2, 0.0)), {}, direction(1.4, pi), {}).weight, Rgb(0.0));
}

TEST(PerturbedNormals, NormalsThatFaceAwayAreMirrored) {
    const Vec3 n = direction(0.9, 0.0), wo = direction(1.2, pi);
    const PerturbedNormal::Options flips{true, false, false};
    EXPECT_EQ(eval(perturbed(Diffuse(Rgb(1.0)), n), {}, wo, {0, 0, 1}), Rgb(0.0));
    EXPECT_NEAR(eval(perturbed(Diffuse(Rgb(1.0)), n, flips), {}, wo, {0, 0, 1}).r, std::cos(0.9) * inv_pi, 1e-15);
    const Vec3 light = direction(1.0, 2.0), turned(-n.x, n.y, n.z);
    EXPECT_NEAR(eval(perturbed(Diffuse(Rgb(1.0)), n, flips), {}, wo, light).r, glm::dot(turned, light) / light.z * inv_pi, 1e-15);
}

// Conty Estevez et al.'s term as they print it: G1 of GGX with α² = min(tan²τ / 8, 1).
TEST(PerturbedNormals, ShadowingOfTheTerminator) {
    const PerturbedNormal::Options shadows{true, true, false};
    const Bsdf bsdf = Diffuse(Rgb(1.0));
    for (const double tilt : {0.2, 0.9, 1.4}) {
        const Vec3 n = direction(tilt, 0.0), wo = direction(0.1, 0.0), wi = direction(0.6, 0.2);
        const double alpha = std::min(std::tan(tilt) / std::sqrt(8.0), 1.0);
        const double G = 2.0 / (1.0 + std::sqrt(1.0 + alpha * alpha * std::tan(0.6) * std::tan(0.6)));
        EXPECT_NEAR(eval(perturbed(bsdf, n, shadows), {}, wo, wi).r, G * eval(perturbed(bsdf, n), {}, wo, wi).r, 1e-14);
    }
}

TEST(PerturbedNormals, SamplesAreWhatEvalAndPdfSay) {
    const SobolPoints points(256);
    for (const Bsdf& nested : {Bsdf(Diffuse(Rgb(0.8))), Bsdf(RoughConductor(Ggx(0.4)))})
        for (const PerturbedNormal::Options& options : {plain, PerturbedNormal::Options{}}) {
            const Bsdf bsdf = perturbed(nested, {0.5, 0.2, 1.0}, options);
            const Vec3 wo = direction(0.9, 2.5);
            Sampler sampler(points, 1, 0);
            int reflected = 0;
            for (std::uint32_t i = 0; i < points.size(); ++i) {
                sampler.start(i);
                const BsdfSample s = sample(bsdf, {}, wo, sampler.next2());
                if (s.weight.r == 0.0) continue;
                ++reflected;
                EXPECT_NEAR(s.pdf, pdf(bsdf, {}, wo, s.wi), 1e-9 * s.pdf);
                EXPECT_NEAR(s.weight.r * s.pdf, eval(bsdf, {}, wo, s.wi).r * s.wi.z, 1e-9 * s.weight.r * s.pdf);
            }
            EXPECT_GT(reflected, 128);
        }
}

// What leaves: ∫ fs cosθi dωi. For a diffuse ρ and without shadowing it is what both hemispheres share, weighted by cosθi':
// ρ (1 + cosτ)/2, whatever ωo, and never more than ρ.
TEST(PerturbedNormals, AlbedoIsAtMostTheNested) {
    for (const double tilt : {0.3, 0.8, 1.3}) {
        const Vec3 wo = direction(0.2, 0.0);
        const auto albedo = [&](const PerturbedNormal::Options& options) {
            const Bsdf bsdf = perturbed(Diffuse(Rgb(0.9)), direction(tilt, 0.0), options);
            EXPECT_EQ(largest_albedo(bsdf), Rgb(0.9));
            return over_directions(tilt, [&](const Vec3& wi) { return eval(bsdf, {}, wo, wi).r; });
        };
        EXPECT_NEAR(albedo(plain), 0.9 * 0.5 * (1.0 + std::cos(tilt)), 1e-9);
        EXPECT_LT(albedo({}), albedo(plain));
    }
}

// What is reflected of light from ωi: ∫ fs cosθo dωo, ρ G cosθi'/cosθi (1 + cosτ)/2. It exceeds 1, as perturbed_normal.h says.
TEST(PerturbedNormals, LightFromOneDirectionMayGainPower) {
    const double tilt = 0.8;
    const auto gain = [&](const PerturbedNormal::Options& options, double theta) {
        const Bsdf bsdf = perturbed(Diffuse(Rgb(1.0)), direction(tilt, 0.0), options);
        const Vec3 wi = direction(theta, 0.0);
        return over_directions(tilt, [&](const Vec3& wo) { return eval(bsdf, {}, wo, wi).r; });
    };
    EXPECT_NEAR(gain(plain, 1.2), std::cos(1.2 - tilt) / std::cos(1.2) * 0.5 * (1.0 + std::cos(tilt)), 1e-9);
    EXPECT_GT(gain(plain, 1.5), 6.0);
    const double limit = 2.0 * std::sqrt(2.0) * std::cos(tilt) * (1.0 + std::cos(tilt));
    EXPECT_NEAR(gain({false, true, false}, 0.5 * pi - 1e-5), limit, 1e-3);
    EXPECT_GT(limit, 3.3);
}

}  // namespace neumann::physics::perturbed_normals_test
