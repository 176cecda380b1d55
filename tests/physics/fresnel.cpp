// What a smooth surface reflects, and the material made of it.
#include "core/material/bsdf.h"

#include <gtest/gtest.h>

#include <complex>

namespace neumann::fresnel_test {

// The amplitudes themselves, in complex numbers.
double fresnel(double cosine, std::complex<double> n) {
    const double sin2 = 1.0 - cosine * cosine;
    const std::complex<double> q = std::sqrt(n * n - sin2), n2 = n * n;
    return 0.5 * (std::norm((cosine - q) / (cosine + q)) + std::norm((n2 * cosine - q) / (n2 * cosine + q)));
}

TEST(Fresnel, IsThatOfTheAmplitudes) {
    for (const double eta : {0.05, 0.143, 0.9, 1.5, 6.0})
        for (const double k : {0.0, 0.01, 1.0, 3.983, 12.0})
            for (const double cosine : {1.0, 0.97, 0.7, 0.3, 0.02, 1e-5})
                EXPECT_NEAR(conductor_fresnel(cosine, eta, k), fresnel(cosine, {eta, k}), 1e-13)
                    << eta << " " << k << " " << cosine;
}

TEST(Fresnel, HasTheValuesOfGlass) {
    const double known[][2] = {
        {0.0, 0.04}, {45.0, 0.050239911012}, {60.0, 0.089186712802}, {80.0, 0.387704354691}, {89.9, 0.989911876919}};
    for (const auto& [degrees, R] : known) EXPECT_NEAR(conductor_fresnel(std::cos(degrees * pi / 180.0), 1.5, 0.0), R, 1e-12);
    // No surface, and hardly one: R(0) = (10^-6/(2 + 10^-6))².
    for (const double cosine : {1.0, 0.5, 1e-3, 1e-9}) EXPECT_LE(conductor_fresnel(cosine, 1.0, 0.0), 1e-30);
    EXPECT_NEAR(conductor_fresnel(1.0, 1.0 + 1e-6, 0.0) / 2.4999975e-13, 1.0, 1e-9);
    EXPECT_NEAR(conductor_fresnel(std::cos(89.9 * pi / 180.0), 1.0 + 1e-6, 0.0), 0.0157553, 5e-8);
}

TEST(Fresnel, WithoutARealPartAllIsReflected) {
    for (const double cosine : {1.0, 0.3, 1e-8})
        for (const double k : {0.0, 0.1, 1.0, 7.0}) EXPECT_EQ(conductor_fresnel(cosine, 0.0, k), 1.0);
    EXPECT_EQ(ConductorFresnel()(0.4), Rgb(1.0));
    EXPECT_EQ(ConductorFresnel(Rgb(0.0), Rgb(1.0))(0.4), Rgb(1.0));
}

// ∫ F(μ) 2μ dμ for n = 1.5; Walsh's closed form gives the same digits.
TEST(Fresnel, HasTheCosineAverageOfGlass) {
    constexpr int n = 4000;
    double sum = 0.0;
    for (int i = 0; i < n; ++i)  // Simpson's rule in √μ, for F has an edge of its own at grazing angles
        for (const auto& [at, weight] : {std::pair{0.0, 1.0}, {0.5, 4.0}, {1.0, 1.0}}) {
            const double s = (i + at) / n, mu = s * s;
            sum += weight / 6.0 / n * conductor_fresnel(mu, 1.5, 0.0) * 2.0 * mu * 2.0 * s;
        }
    EXPECT_NEAR(sum, 0.0917779593423512, 1e-12);
}

TEST(Conductor, IsADeltaWithinItsBound) {
    const Conductor gold({Rgb(0.143, 0.374, 1.442), Rgb(3.983, 2.385, 1.603)}, Rgb(1.0, 0.9, 0.8));
    const Bsdf bsdf = gold;
    EXPECT_EQ(lobe(bsdf).kind, Lobe::Kind::specular);
    for (const double mu : {1.0, 0.6, 0.1, 1e-6}) {
        const Vec3 wo(std::sqrt(1.0 - mu * mu) * 0.6, std::sqrt(1.0 - mu * mu) * 0.8, mu);
        const BsdfSample found = sample(bsdf, {}, wo, Vec2(0.3, 0.7));
        EXPECT_EQ(found.wi, Vec3(-wo.x, -wo.y, wo.z));
        EXPECT_EQ(found.pdf, delta_pdf);
        EXPECT_EQ(pdf(bsdf, {}, wo, found.wi), 0.0);
        EXPECT_TRUE(is_black(eval(bsdf, {}, wo, found.wi)));
        for (int c = 0; c < 3; ++c) {
            EXPECT_GT(found.weight[c], 0.0);
            EXPECT_LE(found.weight[c], largest_albedo(bsdf)[c]);
        }
    }
    EXPECT_TRUE(is_black(sample(bsdf, {}, {0.6, 0, -0.8}, Vec2(0.3, 0.7)).weight));
}

}  // namespace neumann::fresnel_test
