// In a furnace of albedo ρ a walk that goes on with probability q scores (ρ/q)^k at its k-th reflection, with probability q^k.
#include "operators/paths/walk/furnace_walk.h"
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

namespace neumann::physics::roulette_test {

Scene furnace(double rho) {
    SceneMaker maker;
    maker.add(Sphere{{0, 0, 0}, 1.0, true}, glowing(rho, 1.0));
    return maker.make();
}
Estimates ended(const Scene& scene, const Roulette& roulette, std::uint32_t samples) {
    return probe(
        scene, at(scene, {0, 0, 1}, {0, 0, -1}), Technique::bsdf,
        {.samples = samples, .bounces = 8, .rest_probability = 1.0, .sampler = SamplerKind::independent, .roulette = roulette});
}
// Of the sum over all k ≥ 0: Σ_j Σ_k w^(j+k) q^max(j,k) − 1/(1 − ρ)², w = ρ/q.
double variance_of_sum(double rho, double q) {
    const double w = rho / q, mean = 1.0 / (1.0 - rho);
    double sum = 0.0, lower = 0.0;  // Σ_{j<k} w^j
    for (int k = 0; k < 100'000; ++k) {
        const double alive = std::pow(rho, k), weight = std::pow(w, k);
        sum += alive * (weight + 2.0 * lower);
        lower += weight;
    }
    return sum - mean * mean;
}

// verification figures: 90 and 28.93 for ρ = 0.9 and q = 0.9 and 0.95.
TEST(Roulette, TheFormulaGivesTheKnownVariances) {
    EXPECT_NEAR(variance_of_sum(0.9, 0.9), 90.0, 1e-6);
    EXPECT_NEAR(variance_of_sum(0.9, 0.95), 28.93, 0.005);
}

TEST(FurnaceWalk, HasTheKnownLengthsAndSecondMoments) {
    for (const double rho : {0.3, 0.9, 0.99})
        for (const double q : {0.985, 0.995, rho}) {
            const Roulette roulette{q == rho ? Roulette::Kind::albedo : Roulette::Kind::fixed, q};
            const FurnaceWalk walk = furnace_walk(roulette, rho, 8);
            EXPECT_NEAR(walk.vertices * (1.0 - q), 1.0, 1e-12);
            const double expected = variance_of_sum(rho, q) + 1.0 / ((1.0 - rho) * (1.0 - rho));
            EXPECT_NEAR(walk.second_moment / expected, 1.0, 1e-9) << rho << " " << q;
        }
    EXPECT_TRUE(std::isinf(furnace_walk({Roulette::Kind::fixed, 0.8}, 0.9, 8).second_moment));
    EXPECT_TRUE(std::isinf(furnace_walk({Roulette::Kind::albedo}, 1.0, 8).vertices));
    EXPECT_EQ(furnace_walk({Roulette::Kind::albedo}, 0.0, 8).second_moment, 1.0);
    EXPECT_EQ(furnace_walk({}, 0.0, 8).second_moment, 1.0);
}

// E[S²] where the first N vertices are certain: Σ_m P(m further ones) (Σ_{k≤N} ρ^k + ρ^N m)².
TEST(FurnaceWalk, WithoutRouletteBeforeTheLastPicture) {
    for (const double rho : {0.5, 0.9})
        for (const int N : {0, 1, 8}) {
            double sum = 0.0, second = 0.0, length = 0.0;
            for (int k = 0; k <= N; ++k) sum += std::pow(rho, k);
            for (int m = 0; m < 2000; ++m) {
                const double probability = std::pow(rho, m) * (1.0 - rho), score = sum + std::pow(rho, N) * m;
                second += probability * score * score;
                length += probability * (N + 1 + m);
            }
            const FurnaceWalk walk = furnace_walk({}, rho, N);
            EXPECT_NEAR(walk.second_moment / second, 1.0, 1e-12);
            EXPECT_NEAR(walk.vertices / length, 1.0, 1e-12);
        }
}

// Terms, their variances and the length of walks, 1 / (1 − q) vertices: 2 × 19 comparisons.
TEST(RouletteSlow, AFixedSurvival) {
    const double rho = 0.9;
    const Scene scene = furnace(rho);
    for (const double q : {0.9, 0.95}) {
        const Estimates found = ended(scene, {Roulette::Kind::fixed, q}, 1 << 14);
        for (int i = 1; i <= 8; ++i) {
            const auto k = static_cast<std::size_t>(i);
            expect_matches(found.terms[k], std::pow(rho, i), "term");
            expect_matches(found.variance[k], std::pow(rho * rho / q, i) - std::pow(rho, 2 * i), "variance", 0.02);
        }
        expect_matches(found.reflected, 1.0 / (1.0 - rho) - 1.0, "sum", 0.002);
        EXPECT_NEAR(found.rays_mean, 1.0 / (1.0 - q), 4.5 * found.rays_error);
        // Of 64 batches: the standard error of their variance is √(2/63) of it, and more for a distribution with a tail.
        const double one = found.reflected.standard_error.r * found.reflected.standard_error.r * static_cast<double>(found.samples);
        EXPECT_NEAR(one / variance_of_sum(rho, q), 1.0, 4.5 * std::sqrt(2.0 / 63.0));
    }
}

// In a furnace both keep all weights at 1: each term is 0 or 1.
TEST(RouletteSlow, ByAlbedoAndByThroughput) {
    const double rho = 0.8;
    const Scene scene = furnace(rho);
    for (const Roulette::Kind kind : {Roulette::Kind::albedo, Roulette::Kind::throughput}) {
        const Estimates found = ended(scene, {kind}, 1 << 14);
        for (int i = 1; i <= 8; ++i) {
            const auto k = static_cast<std::size_t>(i);
            expect_matches(found.terms[k], std::pow(rho, i), "term", 0.003);
            expect_matches(found.variance[k], std::pow(rho, i) * (1.0 - std::pow(rho, i)), "variance", 0.01);
        }
        EXPECT_NEAR(found.rays_mean, 1.0 / (1.0 - rho), 4.5 * found.rays_error);
    }
}

}  // namespace neumann::physics::roulette_test
