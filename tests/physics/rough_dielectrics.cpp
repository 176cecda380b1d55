// Rough boundaries that let light through: the laws of a material over the whole sphere.
#include "core/sampling/sampler.h"
#include "tests/physics/material_laws.h"
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

namespace neumann::physics::rough_dielectrics_test {

template <class Microfacets>
Bsdf glass(double alpha, double eta) {
    return RoughDielectric<Microfacets>(Microfacets(alpha), eta, Rgb(1.0, 0.9, 0.8), Rgb(0.7, 1.0, 0.6));
}
struct Named {
    std::string name;
    Bsdf bsdf, other_side;
    double eta, alpha;
    bool ggx;
};
std::vector<Named> glasses() {
    std::vector<Named> all;
    for (const double eta : {1.5, 1.0 / 1.5, 2.419})
        for (const double alpha : {0.2, 0.6}) {
            const std::string text = ", eta " + std::to_string(eta) + ", alpha " + std::to_string(alpha);
            all.push_back({"GGX" + text, glass<Ggx>(alpha, eta), glass<Ggx>(alpha, 1.0 / eta), eta, alpha, true});
            all.push_back({"Beckmann" + text, glass<Beckmann>(alpha, eta), glass<Beckmann>(alpha, 1.0 / eta), eta, alpha, false});
        }
    return all;
}

// 12 materials × 3 angles: 36 comparisons, each with the false-alarm rate of |z| > 4.5, 6.8e-6.
TEST(RoughDielectric, DirectionsAreDrawnWithTheirDensity) {
    std::uint32_t stream = 300;
    for (const Named& g : glasses())
        for (const double mu : {1.0, 0.6, 0.2})
            EXPECT_GE(directions_p_value(g.bsdf, {}, at_cosine(mu), stream++), 6.8e-6) << g.name;
}

TEST(RoughDielectric, TheWeightTimesTheDensityIsTheScatteringFunction) {
    for (const Named& g : glasses())
        for (const double mu : {1.0, 0.8, 0.2, 0.05, 1e-4}) {
            SCOPED_TRACE(g.name);
            expect_consistent_samples(g.bsdf, {}, at_cosine(mu));
        }
}

// fs(ωi → ωo)/no² = fs(ωo → ωi)/ni², through the boundary; on one side as ever. Beside total reflection, where 1 − F vanishes, only
// the rounding of F, which is of order 1, can be asked for.
TEST(RoughDielectric, IsReciprocalButForTheSquaredIndex) {
    for (const Named& g : glasses()) {
        EXPECT_LE(largest_irreciprocity(g.bsdf, {}), 1e-10) << g.name;
        Sampler sampler(fixed_seed, 3);
        int let_through = 0;
        for (std::uint64_t i = 0; i < 2000; ++i) {
            sampler.start(i);
            const Vec3 above = uniform_hemisphere(sampler.next2()), below = -uniform_hemisphere(sampler.next2());
            const Rgb one = eval(g.bsdf, {}, above, below), other = eval(g.other_side, {}, -below, -above);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(one[c] * g.eta * g.eta, other[c], 1e-9 * other[c] + 1e-12) << g.name;
            let_through += one.r > 0.0;
        }
        EXPECT_GT(let_through, 300) << g.name;
    }
}

// Equations 20 and 21 of Walter et al. 2007 as they stand there, with G1 of their Λ: what is reflected, and what is let through of
// basic radiance; radiance has 1/η² of it.
TEST(RoughDielectric, IsThatOfWalterAndOthers) {
    for (const Named& g : glasses()) {
        const auto D = [&](double cosine) {
            const double c2 = cosine * cosine, tan2 = (1.0 - c2) / c2, a2 = g.alpha * g.alpha;
            return g.ggx ? a2 / (pi * c2 * c2 * (a2 + tan2) * (a2 + tan2)) : std::exp(-tan2 / a2) / (pi * a2 * c2 * c2);
        };
        const auto G1 = [&](const Vec3& v) {
            const double tan = std::sqrt(1.0 - v.z * v.z) / std::abs(v.z);
            if (g.ggx) return 2.0 / (1.0 + std::sqrt(1.0 + g.alpha * g.alpha * tan * tan));
            const double a = 1.0 / (g.alpha * tan);
            return 2.0 / (1.0 + std::erf(a) + std::exp(-a * a) / (a * std::sqrt(pi)));
        };
        const auto F = [&](double c) {
            const double q = g.eta * g.eta - 1.0 + c * c;
            if (q <= 0.0) return 1.0;
            const double gg = std::sqrt(q), s = (gg - c) / (gg + c), t = (c * (gg + c) - 1.0) / (c * (gg - c) + 1.0);
            return 0.5 * s * s * (1.0 + t * t);
        };
        Sampler sampler(fixed_seed, 4);
        for (std::uint64_t i = 0; i < 1000; ++i) {
            sampler.start(i);
            const Vec3 o = uniform_hemisphere(sampler.next2()), in = uniform_sphere(sampler.next2());
            double exact;
            if (in.z > 0.0) {
                const Vec3 h = glm::normalize(o + in);
                exact = F(glm::dot(o, h)) * G1(o) * G1(in) * D(h.z) / (4.0 * o.z * in.z);
            } else {
                Vec3 h = glm::normalize(-(in * g.eta + o));
                if (h.z < 0.0) h = -h;
                const double oh = glm::dot(o, h), ih = glm::dot(in, h);
                const double both = ih * g.eta + oh;
                exact = oh > 0.0 && ih < 0.0
                            ? std::abs(ih * oh / (in.z * o.z)) * (1.0 - F(oh)) * G1(o) * G1(in) * D(h.z) / (both * both)
                            : 0.0;
            }
            const Rgb found = eval(g.bsdf, {}, o, in);
            const Rgb factor = in.z > 0.0 ? Rgb(1.0, 0.9, 0.8) : Rgb(0.7, 1.0, 0.6);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], factor[c] * exact, 1e-7 * factor[c] * exact + 1e-14) << g.name;
        }
    }
}

// A boundary without colours: what it reflects and lets through of basic radiance. Facets lose nothing but what others hide, so
// that is at most 1, and 1 where they are flat: F is reflected and 1 − F let through. Whether a sample is reflected is as good as
// drawn at random, so the standard error is that of a binomial distribution, √(F (1 − F) / n), and 4.5 of it are exceeded in one
// of 6 comparisons in 4 of 100,000 seeds. Facets of α = 0.002 are not quite flat: the mean F of those that are seen, by quadrature,
// is off by at most 2.9e-4, where total reflection begins 5 degrees away.
TEST(RoughDielectric, LosesOnlyWhatFacetsHide) {
    for (const double eta : {1.5, 1.0 / 1.5})
        for (const double mu : {1.0, 0.9, 0.8}) {
            double before = 0.0;
            for (const double alpha : {0.5, 0.2, 0.02, 0.002}) {
                const Bsdf bsdf = RoughDielectric<Ggx>(Ggx(alpha), eta);
                const Vec3 wo = at_cosine(mu);
                constexpr int samples = 1 << 16;
                SobolPoints points(samples);
                Sampler sampler(points, fixed_seed, 0);
                double reflected = 0.0, let_through = 0.0;
                for (int i = 0; i < samples; ++i) {
                    sampler.start(static_cast<std::uint64_t>(i));
                    const BsdfSample s = sample(bsdf, {}, wo, sampler.next2());
                    (s.wi.z > 0.0 ? reflected : let_through) += s.weight.r / samples * (s.wi.z > 0.0 ? 1.0 : eta * eta);
                }
                EXPECT_LE(reflected + let_through, 1.0);
                EXPECT_GT(reflected + let_through, before);
                before = reflected + let_through;
                if (alpha == 0.002) {
                    const double F = conductor_fresnel(mu, eta, 0.0), standard_error = std::sqrt(F * (1.0 - F) / samples);
                    EXPECT_NEAR(reflected, F, 4.5 * standard_error + 3e-4) << eta << " " << mu;
                    EXPECT_NEAR(let_through, 1.0 - F, 4.5 * standard_error + 3e-4) << eta << " " << mu;
                }
            }
        }
}

// A lamp beyond a rough boundary, a disc that fills the cone around −z with cosine above 0.8: K^1 Le = ∫ fs |cosθ| dω over it, by
// quadrature. And one on the same side, over the cone around +z. 2 glasses × 2 × 4 ways: 16 comparisons.
TEST(RoughDielectricSlow, LampsAreFoundThroughIt) {
    constexpr Technique ways[] = {Technique::mis, Technique::bsdf, Technique::light, Technique::pointwise};
    const double mu = 0.9, edge = 0.8;
    for (const double eta : {1.5, 1.0 / 1.5})
        for (const double side : {1.0, -1.0}) {
            const Bsdf bsdf = RoughDielectric<Ggx>(Ggx(0.3), eta);
            const double exact =
                2.0 * integrate(edge, 1.0, 1e-9, [&](double z) {
                    return integrate(0.0, pi, 1e-9, [&](double phi) {
                        const double r = std::sqrt(1.0 - z * z);
                        return eval(bsdf, {}, at_cosine(mu), Vec3(r * std::cos(phi), r * std::sin(phi), side * z)).r * z;
                    });
                });
            SceneMaker maker;
            maker.add(patch({0, 0, 0}, {0, 0, 1}, 1.0), boundary(bsdf, RoughDielectric<Ggx>(Ggx(0.3), 1.0 / eta)));
            const double radius = 0.75;  // at the height 1: cosine 0.8
            maker.add(Disk{{0, 0, side}, {radius, 0, 0}, {0, radius, 0}, {0, 0, -side}}, lamp(1.0));
            const Scene scene = maker.make();
            const SurfacePoint p = surface_point(scene, {0, 0, 0}, {0, 0, 1});
            const StartPicker start = [p, mu](Random&) { return Start{p, at_cosine(mu)}; };
            for (const Technique way : ways) {
                SCOPED_TRACE(name(way) + ", eta " + std::to_string(eta) + (side > 0.0 ? ", above" : ", below"));
                const double terms[] = {exact};
                expect_matches(probe(scene, start, way, {.samples = 8192, .bounces = 1}), terms, 1, 0.01);
            }
        }
}

TEST(RoughDielectric, StaysFiniteAndWithinItsBounds) {
    for (const double alpha : {1e-4, 1e-2, 1.0})
        for (const double eta : {1.5, 1.0 / 1.5, 1.0003, 4.0})
            for (const Bsdf& bsdf :
                 {Bsdf(RoughDielectric<Ggx>(Ggx(alpha), eta)), Bsdf(RoughDielectric<Beckmann>(Beckmann(alpha), eta))})
                for (const double mu : {1.0, 1.0 - 1e-15, 0.5, 1e-6, 1e-12, 1e-100})
                    for (const double x : {0.0, 1e-12, 0.5, 1.0 - 0x1p-53})
                        for (const double y : {0.0, 1e-12, 0.5, 1.0 - 0x1p-53}) {
                            const Vec3 wo = at_cosine(mu);
                            const BsdfSample found = sample(bsdf, {}, wo, {x, y});
                            EXPECT_TRUE(is_finite(found.wi) && is_finite(found.weight) && std::isfinite(found.pdf))
                                << alpha << " " << eta << " " << mu << " " << x << " " << y;
                            EXPECT_LE(found.weight.r, largest_albedo(bsdf).r * (1.0 + 1e-12));
                            EXPECT_TRUE(is_finite(eval(bsdf, {}, wo, found.wi)));
                        }
    const Bsdf tinted = RoughDielectric<Ggx>(Ggx(0.2), 0.5, Rgb(0.9), Rgb(0.8));
    EXPECT_EQ(largest_albedo(tinted), Rgb(3.2));
    EXPECT_EQ(largest_basic_albedo(tinted), Rgb(0.9));
    EXPECT_TRUE(transmits(tinted));
}

}  // namespace neumann::physics::rough_dielectrics_test
