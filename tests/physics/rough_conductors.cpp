// Rough metals: the laws of a material, by quadrature and χ².
#include "core/sampling/sampler.h"
#include "operators/experiments/known/quadrature.h"
#include "tests/physics/cell_counts.h"
#include "tests/physics/probe.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neumann::physics::rough_conductors_test {

struct Named {
    std::string name;
    Bsdf bsdf;
};
// Coloured metals of both distributions and both kinds of masking.
std::vector<Named> metals(std::initializer_list<Masking> kinds = {Masking::separable, Masking::height_correlated}) {
    const ConductorFresnel gold(Rgb(0.143, 0.374, 1.442), Rgb(3.983, 2.385, 1.603));
    std::vector<Named> all;
    for (const double alpha : {0.05, 0.3, 1.0})
        for (const Masking masking : kinds) {
            const std::string text =
                ", alpha " + std::to_string(alpha) + (masking == Masking::separable ? ", separable" : ", correlated");
            all.push_back({"GGX" + text, RoughConductor(Ggx(alpha), gold, Rgb(1.0, 0.9, 0.8), masking)});
            all.push_back({"Beckmann" + text, RoughConductor(Beckmann(alpha), gold, Rgb(1.0, 0.9, 0.8), masking)});
        }
    return all;
}

// Directions of facets, evenly spread as far as the distribution reaches: tan²θ = α² t/(1 − t), t and φ uniform.
struct FacetDirection {
    Vec3 m;
    double angle_per_t;  // dω/(dt dφ)
};
FacetDirection facet(double alpha, double t, double phi) {
    const double tan2 = alpha * alpha * t / (1.0 - t), cosine = 1.0 / std::sqrt(1.0 + tan2), sine = std::sqrt(tan2) * cosine;
    return {{sine * std::cos(phi), sine * std::sin(phi), cosine},
            0.5 * alpha * alpha * cosine * cosine * cosine / ((1.0 - t) * (1.0 - t))};
}
// The density of facets that pdf() amounts to; the mirror image of a facet's direction moves by 4 ωo·m times as much.
double visible_density(const Bsdf& bsdf, const Vec3& wo, const FacetDirection& f) {
    const double cosine = glm::dot(wo, f.m);
    return cosine > 0.0 ? pdf(bsdf, {}, wo, 2.0 * cosine * f.m - wo) * 4.0 * cosine * f.angle_per_t : 0.0;
}

// Facets that are steeper than the view, from `turning` on, are seen on one side only, up to |φ| = `last`. With t = 1 − q².
TEST(RoughConductor, TheDensityOfDirectionsIntegratesToOne) {
    for (const auto& [name, bsdf] : metals({Masking::separable}))
        for (const double mu : cosines) {
            const double alpha = lobe(bsdf).alpha, sine = std::sqrt(1.0 - mu * mu);
            const double turning = alpha * sine / std::hypot(alpha * sine, mu);
            const auto ring = [&](double q) {
                const double t = 1.0 - q * q, cotangent = mu * q / (sine * alpha * std::sqrt(t));
                const double last = cotangent < 1.0 ? std::acos(-cotangent) : pi;
                return 2.0 * q * 2.0 * integrate_smooth(0.0, last, [&](double phi) {
                           return visible_density(bsdf, at_cosine(mu), facet(alpha, t, phi));
                       });
            };
            EXPECT_NEAR(integrate_smooth(0.0, turning, ring) + integrate_smooth(turning, 1.0, ring), 1.0, 1e-7)
                << name << ", cosine " << mu;
        }
}

// χ² of 131072 directions in 16 × 24 cells, by the facets that reflect them. 6 metals × 5 angles: 30 comparisons, each with the
// false-alarm rate of |z| > 4.5, 6.8e-6.
TEST(RoughConductorSlow, DirectionsAreDrawnWithTheirDensity) {
    constexpr int rings = 16, sectors = 24, count = 131072;
    std::uint32_t stream = 0;
    for (const auto& [name, bsdf] : metals({Masking::separable}))
        for (const double mu : cosines) {
            const Vec3 wo = at_cosine(mu);
            const double alpha = lobe(bsdf).alpha;
            std::vector<double> found(rings * sectors);
            Sampler sampler(fixed_seed, stream++);
            for (int i = 0; i < count; ++i) {
                sampler.start(static_cast<std::uint64_t>(i));
                const Vec3 m = glm::normalize(wo + sample(bsdf, {}, wo, sampler.next2()).wi);
                const double tan2 = (m.x * m.x + m.y * m.y) / (m.z * m.z), t = tan2 / (alpha * alpha + tan2);
                const double turn = std::atan2(m.y, m.x) / (2.0 * pi);
                const int ring = std::min(static_cast<int>(t * rings), rings - 1);
                const int sector = std::min(static_cast<int>((turn < 0.0 ? turn + 1.0 : turn) * sectors), sectors - 1);
                found[static_cast<std::size_t>(ring * sectors + sector)] += 1.0;
            }
            CellCounts cells;
            for (int ring = 0; ring < rings; ++ring)
                for (int sector = 0; sector < sectors; ++sector) {
                    const double turn = 2.0 * pi / sectors;
                    const double expected =
                        count * integrate<15>(static_cast<double>(ring) / rings, (ring + 1.0) / rings, 1e-4, [&](double t) {
                            return integrate(turn * sector, turn * (sector + 1), 1e-6,
                                             [&](double phi) { return visible_density(bsdf, wo, facet(alpha, t, phi)); });
                        });
                    cells.add(found[static_cast<std::size_t>(ring * sectors + sector)], expected);
                }
            if (!cells.join_few()) {
                EXPECT_LE(cells.few_found, 40.0) << name << ", cosine " << mu;
            }
            EXPECT_GE(cells.p(), 6.8e-6) << name << ", cosine " << mu << ": χ² = " << cells.chi2 << " in " << cells.cells
                                         << " cells";
        }
}

TEST(RoughConductor, TheWeightTimesTheDensityIsTheScatteringFunction) {
    for (const auto& [name, bsdf] : metals())
        for (const double mu : {1.0, 0.8, 0.5, 0.2, 0.05, 1e-4}) {
            const Vec3 wo = at_cosine(mu);
            Sampler sampler(fixed_seed, 1);
            for (std::uint64_t i = 0; i < 1000; ++i) {
                sampler.start(i);
                const BsdfSample found = sample(bsdf, {}, wo, sampler.next2());
                EXPECT_NEAR(glm::length(found.wi), 1.0, 1e-14);
                EXPECT_NEAR(pdf(bsdf, {}, wo, found.wi) / found.pdf, 1.0, 1e-9) << name;
                const Rgb exact = eval(bsdf, {}, wo, found.wi) * std::abs(found.wi.z);
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(found.weight[c] * found.pdf, exact[c], 1e-9 * exact[c]) << name;
            }
        }
}

TEST(RoughConductor, IsReciprocal) {
    for (const auto& [name, bsdf] : metals()) {
        Sampler sampler(fixed_seed, 2);
        for (std::uint64_t i = 0; i < 1000; ++i) {
            sampler.start(i);
            const Vec3 a = uniform_hemisphere(sampler.next2()), b = uniform_hemisphere(sampler.next2());
            const Rgb one = eval(bsdf, {}, a, b), other = eval(bsdf, {}, b, a);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(one[c], other[c], 1e-10 * one[c]) << name;
        }
    }
}

TEST(RoughConductor, NothingIsReflectedBelowTheHorizonOrFromBehind) {
    for (const auto& [name, bsdf] : metals()) {
        const Vec3 up = at_cosine(0.3), down(0.6, 0.0, -0.8);
        EXPECT_TRUE(is_black(eval(bsdf, {}, up, down))) << name;
        EXPECT_TRUE(is_black(eval(bsdf, {}, down, up))) << name;
        EXPECT_EQ(pdf(bsdf, {}, down, up), 0.0) << name;
        EXPECT_TRUE(is_black(sample(bsdf, {}, down, Vec2(0.3)).weight)) << name;
    }
}

TEST(RoughConductor, ReflectsNoMoreThanItsBound) {
    for (const auto& [name, bsdf] : metals()) {
        EXPECT_EQ(lobe(bsdf).kind, Lobe::Kind::rough);
        for (const double mu : {1.0, 0.8, 0.5, 0.2, 0.05, 0.01})
            for (int c = 0; c < 3; ++c) {
                const double found = albedo(bsdf, mu, c, 1e-6);
                EXPECT_GT(found, 0.0);
                EXPECT_LE(found, largest_albedo(bsdf)[c]) << name << ", cosine " << mu;
            }
    }
}

// Grazing directions, facing ones and very smooth metals leave every number finite.
TEST(RoughConductor, IsFiniteAtTheExtremes) {
    for (const double alpha : {1e-4, 1e-2, 1.0, 4.0})
        for (const Masking masking : {Masking::separable, Masking::height_correlated})
            for (const Bsdf& bsdf : {Bsdf(RoughConductor(Ggx(alpha), {}, Rgb(1.0), masking)),
                                     Bsdf(RoughConductor(Beckmann(alpha), {}, Rgb(1.0), masking))})
                for (const double mu : {1.0, 1.0 - 1e-15, 0.5, 1e-6, 1e-12, 1e-100})
                    for (const double x : {0.0, 1e-12, 0.5, 1.0 - 0x1p-53})
                        for (const double y : {0.0, 1e-12, 0.5, 1.0 - 0x1p-53}) {
                            const Vec3 wo = at_cosine(mu);
                            const BsdfSample found = sample(bsdf, {}, wo, {x, y});
                            EXPECT_TRUE(is_finite(found.wi) && is_finite(found.weight) && std::isfinite(found.pdf))
                                << alpha << " " << mu << " " << x << " " << y;
                            EXPECT_LE(found.weight.r, 1.0 + 1e-12);
                            EXPECT_TRUE(is_finite(eval(bsdf, {}, wo, found.wi)));
                            EXPECT_TRUE(std::isfinite(pdf(bsdf, {}, wo, found.wi)));
                        }
}

// α = 10⁻²: D at 0 and at two of its widths, by the formula in higher precision; D(0) = 1/(π α²).
TEST(RoughConductor, TheDensityOfSmoothMetalsKeepsItsDigits) {
    for (const double alpha : {1e-2, 1e-3, 1e-4}) {
        EXPECT_NEAR(Ggx(alpha).density({0, 0, 1}) * pi * alpha * alpha, 1.0, 1e-14);
        const long double s = 2.0L * alpha, c2 = 1.0L - s * s, a2 = static_cast<long double>(alpha) * alpha;
        const long double exact = a2 / (3.14159265358979323846L * (s * s + a2 * c2) * (s * s + a2 * c2));
        const Vec3 m(2.0 * alpha, 0.0, std::sqrt(1.0 - 4.0 * alpha * alpha));
        EXPECT_NEAR(Ggx(alpha).density(m) / static_cast<double>(exact), 1.0, 1e-14);
    }
}

}  // namespace neumann::physics::rough_conductors_test
