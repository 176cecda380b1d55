// Coatings: the laws of a material, by quadrature and χ², and what is known of a layer over a mirror and over a matt base.
#include "tests/physics/material_laws.h"

#include <complex>

namespace neumann::physics::coatings_test {

const Rgb stain(0.1, 0.4, 1.2), tint(1.0, 0.9, 0.8);

std::shared_ptr<const Bsdf> shared(Bsdf bsdf) { return std::make_shared<const Bsdf>(std::move(bsdf)); }

struct Named {
    std::string name;
    Bsdf bsdf;
};
// Beyond its critical angle a bubble reflects all; that angle has the cosine 1/2, where cells of directions end.
std::vector<Named> coatings() {
    const auto matt = shared(Diffuse(Rgb(0.2, 0.6, 0.95))), rough = shared(RoughConductor(Ggx(0.3), {}, Rgb(0.9, 0.6, 0.3))),
               mirror = shared(Conductor({}, Rgb(0.8)));
    return {{"matt", Coating(matt, 1.5, Rgb(0.0), tint)},
            {"matt, stained", Coating(matt, 1.5, stain, tint)},
            {"matt, a bubble", Coating(matt, std::sqrt(0.75), stain, tint)},
            {"rough", Coating(rough, 1.7, stain, tint)},
            {"mirror", Coating(mirror, 1.5, stain, tint)},
            {"twice", Coating(shared(Coating(rough, 1.3, stain, Rgb(1.0))), 1.5, Rgb(0.0), tint)},
            {"nothing below", Coating(nullptr, 1.5, stain, tint)}};
}
// The amplitudes' way, n real.
double fresnel(double cosine, double n) {
    const std::complex<double> q = std::sqrt(std::complex<double>(n * n - 1.0 + cosine * cosine));
    return 0.5 * (std::norm((cosine - q) / (cosine + q)) + std::norm((n * n * cosine - q) / (n * n * cosine + q)));
}

// 7 coatings × 3 angles: 21 comparisons, each with the false-alarm rate of |z| > 4.5, 6.8e-6. The share of those drawn nowhere,
// because they are deltas, or reflected inwards, is compared as well.
TEST(Coating, DirectionsAreDrawnWithTheirDensity) {
    std::uint32_t stream = 400;
    for (const auto& [name, bsdf] : coatings())
        for (const double mu : {1.0, 0.6, 0.2})
            EXPECT_GE(directions_p_value(bsdf, {}, at_cosine(mu), stream++), 6.8e-6) << name << ", cosine " << mu;
}

TEST(Coating, TheWeightTimesTheDensityIsTheScatteringFunction) {
    for (const auto& [name, bsdf] : coatings()) {
        SCOPED_TRACE(name);
        for (const double mu : {1.0, 0.8, 0.3, 0.01}) expect_consistent_samples(bsdf, {}, at_cosine(mu), 1e-8);
    }
}

TEST(Coating, IsReciprocal) {
    for (const auto& [name, bsdf] : coatings()) EXPECT_LE(largest_irreciprocity(bsdf, {}), 1e-9) << name;
}

TEST(Coating, NothingIsReflectedBelowTheHorizonOrFromBehind) {
    for (const auto& [name, bsdf] : coatings()) {
        const Vec3 up = at_cosine(0.3), down(0.6, 0.0, -0.8);
        EXPECT_TRUE(is_black(eval(bsdf, {}, up, down))) << name;
        EXPECT_TRUE(is_black(eval(bsdf, {}, down, up))) << name;
        EXPECT_EQ(pdf(bsdf, {}, down, up), 0.0) << name;
        EXPECT_TRUE(is_black(sample(bsdf, {}, down, Vec2(0.3)).weight)) << name;
    }
}

// The mean weight of 2^16 directions of a grid is the albedo, deltas included.
Rgb mean_weight(const Bsdf& bsdf, double mu) {
    constexpr int n = 256;
    Rgb sum(0.0);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) sum += sample(bsdf, {}, at_cosine(mu), {(i + 0.5) / n, (j + 0.5) / n}).weight;
    return sum / double{n * n};
}

TEST(Coating, ReflectsNoMoreThanItsBound) {
    for (const auto& [name, bsdf] : coatings())
        for (const double mu : {1.0, 0.5, 0.1, 0.01})
            for (int c = 0; c < 3; ++c)
                EXPECT_LE(mean_weight(bsdf, mu)[c], largest_albedo(bsdf)[c] * (1.0 + 1e-3)) << name << ", cosine " << mu;
    EXPECT_NEAR(largest_albedo(Coating(shared(Diffuse(Rgb(0.9))), 1.5, stain, Rgb(0.1)))[0], 0.9 * std::exp(-0.2), 1e-15);
}

// A mirror below: s F + a (1 − F)² exp(−2 σ/cosθ'), all in one direction.
TEST(Coating, OverAMirrorReflectsTwice) {
    for (const double eta : {1.3, 1.5, 2.0}) {
        const Bsdf bsdf = Coating(shared(Conductor({}, Rgb(0.8))), eta, stain, tint);
        for (const double mu : {1.0, 0.7, 0.2}) {
            const double F = fresnel(mu, eta), inside = std::sqrt(1.0 - (1.0 - mu * mu) / (eta * eta));
            const Vec3 wo = at_cosine(mu);
            const BsdfSample first = sample(bsdf, {}, wo, Vec2(0.0, 0.5)), second = sample(bsdf, {}, wo, Vec2(0.999999, 0.5));
            for (const BsdfSample& s : {first, second}) {
                EXPECT_EQ(s.pdf, delta_pdf);
                EXPECT_NEAR(glm::distance(s.wi, Vec3(-wo.x, -wo.y, wo.z)), 0.0, 1e-12);
            }
            // Both shares are chosen with the probability q and 1 − q.
            const double q = tint.r * F / first.weight.r;
            EXPECT_GT(q, 0.0);
            EXPECT_LT(q, 1.0);
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(first.weight[c] * q, tint[c] * F, 1e-12);
                EXPECT_NEAR(second.weight[c] * (1.0 - q), 0.8 * (1.0 - F) * (1.0 - F) * std::exp(-2.0 * stain[c] / inside), 1e-12);
            }
        }
    }
}

// A matt base: ρ (1 − F) (1 − F̄)/η² with the mean F̄ of light from outside; what is reflected inwards is lost.
TEST(Coating, OverAMattBaseReflectsWhatItsFormulaSays) {
    for (const double eta : {1.3, 1.5, 2.0}) {
        const Bsdf bsdf = Coating(shared(Diffuse(Rgb(0.7))), eta, Rgb(0.0), Rgb(1.0));
        for (const double mu : {1.0, 0.7, 0.2}) {
            const double exact = 0.7 * (1.0 - fresnel(mu, eta)) * (1.0 - diffuse_fresnel(eta)) / (eta * eta);
            EXPECT_NEAR(albedo(bsdf, mu, 0, 1e-6), exact, 2e-5) << eta << " " << mu;
        }
    }
}

// Without a boundary and without absorption nothing is there; with absorption alone Beer's law.
TEST(Coating, OfTheIndexOfAirIsTheMaterialBelow) {
    const Bsdf below = RoughConductor(Ggx(0.3)), clear = Coating(shared(below), 1.0, Rgb(0.0), Rgb(1.0)),
               stained = Coating(shared(below), 1.0, stain, Rgb(1.0));
    const Vec3 wo = at_cosine(0.6), wi = glm::normalize(Vec3(-0.3, 0.5, 0.4));
    EXPECT_NEAR(eval(clear, {}, wo, wi).g, eval(below, {}, wo, wi).g, 1e-12);
    EXPECT_NEAR(pdf(clear, {}, wo, wi), pdf(below, {}, wo, wi), 1e-12);
    EXPECT_NEAR(eval(stained, {}, wo, wi).b / eval(below, {}, wo, wi).b, std::exp(-stain.b * (1.0 / wo.z + 1.0 / wi.z)), 1e-12);
}

}  // namespace neumann::physics::coatings_test
