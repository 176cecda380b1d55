// Plastics, smooth and rough: the laws of a material, by quadrature and χ², and Mitsuba's sums.
#include "tests/physics/material_laws.h"

#include <complex>

namespace neumann::physics::plastics_test {

struct Named {
    std::string name;
    Bsdf bsdf;
};
const Rgb paint(0.1, 0.5, 0.95), tint(1.0, 0.9, 0.8);

std::vector<Named> smooth() {
    std::vector<Named> all;
    for (const double eta : {1.3, 1.49, 2.0, 1.0 / 1.33})
        for (const bool nonlinear : {false, true})
            all.push_back({"eta " + std::to_string(eta) + (nonlinear ? ", nonlinear" : ""), Plastic(eta, paint, tint, nonlinear)});
    return all;
}
// Of a roughness that varies, up to 0.5, where it is this.
RoughPlastic<Ggx> varying(double alpha) {
    const SurfaceFunction here([alpha](const ShadingPoint&) { return Rgb(alpha); }, Rgb(0.5), true);
    return {Roughness<Ggx>(here, here), 1.49, paint, tint, true};
}
std::vector<Named> rough() {
    std::vector<Named> all;
    for (const double alpha : {0.1, 0.5}) {
        const std::string text = ", alpha " + std::to_string(alpha);
        all.push_back({"GGX" + text, RoughPlastic(Ggx(alpha), 1.49, paint, tint, false)});
        all.push_back({"Beckmann" + text, RoughPlastic(Beckmann(alpha), 1.49, paint, tint, true)});
    }
    all.push_back({"GGX, alpha varies", varying(0.23)});
    return all;
}
const std::vector<Named>& plastics() {
    static const std::vector<Named> all = [] {
        std::vector<Named> both = smooth();
        for (Named& n : rough()) both.push_back(std::move(n));
        return both;
    }();
    return all;
}

// The amplitudes' way, n real.
double fresnel(double cosine, double n) {
    const std::complex<double> q = std::sqrt(std::complex<double>(n * n - 1.0 + cosine * cosine));
    return 0.5 * (std::norm((cosine - q) / (cosine + q)) + std::norm((n * n * cosine - q) / (n * n * cosine + q)));
}
// ∫ f(μ) 2μ dμ.
template <class Function>
double mean_over_cosines(const Function& f) {
    return integrate_smooth(0.0, 1.0, [&](double s) { return f(s * s) * 4.0 * s * s * s; });
}

TEST(DiffuseFresnel, IsTheIntegral) {
    EXPECT_NEAR(diffuse_fresnel(1.5), 0.0917779593423512, 1e-12);  // as in fresnel.cpp
    for (const double n : {1.01, 1.1, 1.33, 1.8, 2.4, 4.0}) {
        EXPECT_NEAR(diffuse_fresnel(n), mean_over_cosines([&](double mu) { return fresnel(mu, n); }), 1e-10) << n;
        // From inside all is reflected beyond the critical angle.
        const double critical = std::sqrt(1.0 - 1.0 / (n * n));
        const double inside = 1.0 - 1.0 / (n * n) + integrate_smooth(0.0, 1.0, [&](double s) {
                                  const double mu = critical + (1.0 - critical) * s * s;
                                  return fresnel(mu, 1.0 / n) * 2.0 * mu * (1.0 - critical) * 2.0 * s;
                              });
        EXPECT_NEAR(diffuse_fresnel(1.0 / n), inside, 1e-6) << n;
    }
}

// The errors that their authors state.
TEST(DiffuseFresnel, TheFitsAreAsGoodAsTheySay) {
    for (const double n : {1.1, 1.2, 1.33, 1.49})
        EXPECT_NEAR(fitted_diffuse_fresnel(1.0 / n) / diffuse_fresnel(1.0 / n), 1.0, 6e-3) << n;
    for (const double n : {1.5, 1.6, 1.8, 2.0})
        EXPECT_NEAR(fitted_diffuse_fresnel(1.0 / n) / diffuse_fresnel(1.0 / n), 1.0, 6e-3) << n;
    for (const double n : {1.1, 1.33, 1.5, 2.0, 3.0, 5.0})
        EXPECT_NEAR(fitted_diffuse_fresnel(n) / diffuse_fresnel(n), 1.0, 3e-3) << n;
}

// 8 smooth and 4 rough ones × 3 angles: 36 comparisons, each with the false-alarm rate of |z| > 4.5, 6.8e-6.
TEST(Plastic, DirectionsAreDrawnWithTheirDensity) {
    std::uint32_t stream = 0;
    for (const auto& [name, bsdf] : plastics())
        for (const double mu : {1.0, 0.6, 0.15})
            EXPECT_GE(directions_p_value(bsdf, {}, at_cosine(mu), stream++), 6.8e-6) << name << ", cosine " << mu;
}

TEST(Plastic, TheWeightTimesTheDensityIsTheScatteringFunction) {
    for (const auto& [name, bsdf] : plastics()) {
        SCOPED_TRACE(name);
        for (const double mu : {1.0, 0.8, 0.3, 0.01}) expect_consistent_samples(bsdf, {}, at_cosine(mu));
    }
}

TEST(Plastic, IsReciprocal) {
    for (const auto& [name, bsdf] : plastics()) EXPECT_LE(largest_irreciprocity(bsdf, {}), 1e-10) << name;
}

TEST(Plastic, NothingIsReflectedBelowTheHorizonOrFromBehind) {
    for (const auto& [name, bsdf] : plastics()) {
        const Vec3 up = at_cosine(0.3), down(0.6, 0.0, -0.8);
        EXPECT_TRUE(is_black(eval(bsdf, {}, up, down))) << name;
        EXPECT_TRUE(is_black(eval(bsdf, {}, down, up))) << name;
        EXPECT_EQ(pdf(bsdf, {}, down, up), 0.0) << name;
        EXPECT_TRUE(is_black(sample(bsdf, {}, down, Vec2(0.3)).weight)) << name;
    }
}

// What the deltas of smooth plastic carry: their weight is the same for all numbers that choose them.
Rgb delta_albedo(const Bsdf& bsdf, double mu) {
    const BsdfSample s = sample(bsdf, {}, at_cosine(mu), Vec2(0.0, 0.5));
    if (s.pdf != delta_pdf) return Rgb(0.0);
    return s.weight * (1.0 - over_hemisphere(mu, 1e-10, [&](const Vec3& wi) { return pdf(bsdf, {}, at_cosine(mu), wi); }));
}

// s F + b (1 − F) (1 − F̄) by the amplitudes; F̄ inside is Egan and Hilgeman's, or d'Eon and Irving's for the bubble.
TEST(Plastic, ReflectsWhatItsFormulaSays) {
    for (const double eta : {1.3, 1.49, 2.0, 1.0 / 1.33})
        for (const bool nonlinear : {false, true}) {
            const Bsdf bsdf = Plastic(eta, paint, tint, nonlinear);
            const double inside = fitted_diffuse_fresnel(1.0 / eta);
            const double outside = diffuse_fresnel(eta);
            for (const double mu : {1.0, 0.7, 0.2}) {
                const double F = fresnel(mu, eta);
                const Rgb of_deltas = delta_albedo(bsdf, mu);
                for (int c = 0; c < 3; ++c) {
                    const double b = paint[c] / (eta * eta * (1.0 - inside * (nonlinear ? paint[c] : 1.0)));
                    EXPECT_NEAR(of_deltas[c], tint[c] * F, 1e-9) << eta << " " << mu;
                    EXPECT_NEAR(albedo(bsdf, mu, c, 1e-6), b * (1.0 - F) * (1.0 - outside), 2e-5) << eta << " " << mu;
                }
            }
        }
}

TEST(Plastic, ReflectsNoMoreThanItsBound) {
    for (const auto& [name, bsdf] : plastics()) {
        for (int c = 0; c < 3; ++c) EXPECT_LE(largest_albedo(bsdf)[c], 1.0) << name;
        for (const double mu : {1.0, 0.6, 0.2, 0.02}) {
            const Rgb of_deltas = delta_albedo(bsdf, mu);
            for (int c = 0; c < 3; ++c)
                EXPECT_LE(albedo_of_both_sides(bsdf, at_cosine(mu), c) + of_deltas[c], largest_albedo(bsdf)[c] * (1.0 + 1e-3))
                    << name << ", cosine " << mu;
        }
    }
}

// Without absorption light that goes in comes out again: 1, but for the fit's error. Seen from it, the error of b is
// (1 − F̄)/(1 − fit).
TEST(Plastic, AWhiteBaseGivesAllBack) {
    for (const double eta : {1.2, 1.33, 1.49, 1.7, 2.0})
        for (const bool nonlinear : {false, true}) {
            const Rgb most = largest_albedo(Plastic(eta, Rgb(1.0), Rgb(1.0), nonlinear));
            EXPECT_NEAR(most.g, 1.0, 1.3e-3) << eta;
            EXPECT_GE(most.g, 1.0);
        }
    EXPECT_NEAR(largest_albedo(Plastic(2.419, Rgb(1.0), Rgb(1.0), true)).g, 1.03, 0.01);
}

// Walter et al., Microfacet Models for Refraction through Rough Surfaces, 2007, eq. 21: T as an integral over directions inside.
template <class Microfacets>
double walter_transmittance(const Microfacets& facets, double eta, double mu) {
    const Vec3 wo = at_cosine(mu);
    return over_hemisphere(mu, 1e-6, [&](const Vec3& up) {
        const Vec3 wi(up.x, up.y, -up.z);
        Vec3 m = -(wo + eta * wi);
        m = m.z < 0.0 ? -glm::normalize(m) : glm::normalize(m);
        const double o = glm::dot(wo, m), i = glm::dot(wi, m);
        if (o <= 0.0 || i >= 0.0) return 0.0;
        const double area = facets.projected_area(wo) * facets.projected_area(up), bend = o + eta * i;
        return -o * i * eta * eta * (1.0 - fresnel(o, eta)) * facets.density(m) * up.z / (area * bend * bend);
    });
}
TEST(RoughPlastic, ItsTransmittanceIsThatOfRoughGlass) {
    for (const double alpha : {0.2, 0.5}) {
        const RoughTransmittance ggx(Ggx(alpha), 1.49), beckmann(Beckmann(alpha), 1.49);
        for (const int node : {63, 40, 12}) {
            const double mu = node / 63.0;
            EXPECT_NEAR(ggx(mu), walter_transmittance(Ggx(alpha), 1.49, mu), 5e-4) << alpha << " " << mu;
            EXPECT_NEAR(beckmann(mu), walter_transmittance(Beckmann(alpha), 1.49, mu), 5e-4) << alpha << " " << mu;
        }
    }
}

// For α → 0 it is smooth: T = 1 − F, linear between the nodes, and F̄ the sum over the nodes.
TEST(RoughPlastic, WithHardlyAnyRoughnessIsSmooth) {
    const RoughTransmittance T(Ggx(1e-4), 1.49);
    double sum = 0.0;
    for (int i = 1; i < 64; ++i) {
        const double mu = i / 63.0;
        EXPECT_NEAR(T(mu), 1.0 - fresnel(mu, 1.49), 3e-4) << i;
        sum += fresnel(mu, 1.0 / 1.49) * mu * 2.0 / 64.0;
    }
    EXPECT_NEAR(T.internal_reflectance(), sum, 1e-3);
    EXPECT_NEAR(T(10.5 / 63.0), 0.5 * (T(10.0 / 63.0) + T(11.0 / 63.0)), 1e-15);
    EXPECT_NEAR(T.mean(), mean_over_cosines([&](double mu) { return T(mu); }), 1e-5);
}

// Wherever the roughness is this, it is the same as if it were this everywhere, but for what a table of some is off between them.
TEST(RoughPlastic, ItsRoughnessMayVary) {
    for (const double alpha : {0.02, 0.11, 0.23, 0.37, 0.5}) {
        const RoughPlastic<Ggx> here = varying(alpha), everywhere(Ggx(alpha), 1.49, paint, tint, true);
        for (const double o : {0.1, 0.5, 0.95})
            for (const double i : {0.1, 0.5, 0.95}) {
                const Vec3 wo = at_cosine(o), wi = at_cosine(i);
                const Rgb found = here.eval({}, wo, wi), wanted = everywhere.eval({}, wo, wi);
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], wanted[c], 2e-3 * wanted[c]) << alpha << ", " << o << ", " << i;
                EXPECT_NEAR(here.pdf({}, wo, wi), everywhere.pdf({}, wo, wi), 2e-3 * everywhere.pdf({}, wo, wi));
            }
    }
    EXPECT_FALSE(varying(0.2).is_constant());
}

}  // namespace neumann::physics::plastics_test
