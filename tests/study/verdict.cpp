// The interval of a ratio, the verdict on a picture, the repeats that an interval takes, and what the times of a study are expected
// to be.
#include "operators/experiments/study/verdict.h"

#include "operators/experiments/study/repeats.h"
#include "operators/statistics/student_t.h"
#include "tests/physics/seed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace neumann::verdict_test {

constexpr double infinity = std::numeric_limits<double>::infinity();

// With an exact denominator the interval is that of the numerator.
TEST(RatioInterval, OfAnExactDenominator) {
    const RatioInterval found = ratio_interval({10.0, 1.0}, {2.0, 0.0}, 2.0);
    EXPECT_EQ(found.ratio, 5.0);
    EXPECT_NEAR(found.low, 4.0, 1e-15);
    EXPECT_NEAR(found.high, 6.0, 1e-15);
    EXPECT_NEAR(ratio_interval({2.0, 0.0}, {10.0, 1.0}, 2.0).low, 1.0 / 6.0, 1e-15);
    EXPECT_NEAR(ratio_interval({2.0, 0.0}, {10.0, 1.0}, 2.0).high, 1.0 / 4.0, 1e-15);
}

// The ends solve (y − ρ x)² = t² (σ_y² + ρ² σ_x²).
TEST(RatioInterval, EndsSolveTheEquation) {
    for (const double t : {1.0, 2.0, 3.0}) {
        const RatioInterval found = ratio_interval({3.0, 0.4}, {1.3, 0.2}, t);
        for (const double rho : {found.low, found.high})
            EXPECT_NEAR(std::abs(3.0 - rho * 1.3), t * std::hypot(0.4, 0.2 * rho), 1e-12) << t;
        EXPECT_LT(found.low, found.ratio);
        EXPECT_GT(found.high, found.ratio);
    }
}

TEST(RatioInterval, HasNoEndWhereTheDenominatorMayBeZero) {
    const RatioInterval above = ratio_interval({3.0, 0.1}, {0.1, 0.1}, 2.0);
    EXPECT_EQ(above.high, infinity);
    EXPECT_GT(above.low, 1.0);
    const RatioInterval any = ratio_interval({0.1, 0.1}, {0.1, 0.1}, 2.0);
    EXPECT_EQ(any.low, 0.0);
    EXPECT_EQ(any.high, infinity);
    EXPECT_EQ(ratio_interval({1.0, 0.1}, {0.0, 0.0}, 2.0).low, infinity);
    EXPECT_EQ(ratio_interval({0.0, 0.0}, {0.0, 0.0}, 2.0).low, 0.0);
}

// Fieller's set is exact for normal values of known errors, also where the denominator is uncertain: of 40 000 it holds 95%, with a
// standard error of 0.11%. Three comparisons at 4.5 of them, a false alarm of 2e-5.
TEST(RatioInterval, HoldsTheTruthAsOftenAsItSays) {
    std::mt19937_64 random(physics::fixed_seed);
    std::normal_distribution<double> normal;
    constexpr int trials = 40000;
    for (const double noise : {0.02, 0.1, 0.2}) {
        int held = 0;
        for (int i = 0; i < trials; ++i) {
            const double y = 2.0 + 0.3 * normal(random), x = 1.0 + noise * normal(random);
            const RatioInterval found = ratio_interval({y, 0.3}, {x, noise}, student_t_quantile(0.95, infinity));
            held += found.low <= 2.0 && 2.0 <= found.high;
        }
        EXPECT_NEAR(held / static_cast<double>(trials), 0.95, 4.5 * std::sqrt(0.95 * 0.05 / trials)) << noise;
    }
}

StudiedMethod studied(std::size_t number, double mse, double mse_error, double seconds) {
    StudiedMethod method{number, {}};
    PointSummary& point = method.summary.points.emplace_back();
    point.mse = {mse, mse_error};
    point.seconds = {seconds, 0.0};
    return method;
}

TEST(StudyVerdict, IsOnTimesToTheSameError) {
    StudiedPicture picture;
    picture.methods = {studied(2, 1e-4, 1e-6, 2.0), studied(0, 1e-2, 1e-4, 4.0), studied(1, 1e-4, 3e-6, 2.02)};
    const StudyVerdict verdict = verdict_on(picture, 16);
    EXPECT_EQ(verdict.best, 2u);
    EXPECT_FALSE(verdict.own_error.has_value());
    ASSERT_EQ(verdict.others.size(), 2u);
    EXPECT_EQ(verdict.others[0].method, 0u);
    EXPECT_NEAR(verdict.others[0].times.ratio, 200.0, 1e-9);
    EXPECT_TRUE(verdict.others[0].is_seen());
    EXPECT_NEAR(verdict.others[1].times.ratio, 1.01, 1e-9);
    EXPECT_FALSE(verdict.others[1].is_seen());  // 1% apart, with errors of 1% and 3%
    // Three pairs: each interval is one of 1 − 0.05/3.
    const double t = student_t_quantile(1.0 - 0.05 / 3.0, 15.0);
    const RatioInterval expected = ratio_interval({4e-2, 4e-4}, {2e-4, 2e-6}, t);
    EXPECT_NEAR(verdict.others[0].times.low, expected.low, 1e-9);
    EXPECT_NEAR(verdict.others[0].times.high, expected.high, 1e-9);
}

TEST(StudyVerdict, SaysNothingOfInfiniteVariances) {
    StudiedPicture picture;
    picture.methods = {studied(0, 1e-4, 1e-6, 1.0), studied(1, 1.0, 1e-2, 1.0)};
    picture.methods[1].summary.infinite_variance = true;
    EXPECT_FALSE(verdict_on(picture, 8).others[0].is_seen());
    EXPECT_TRUE(verdict_on(picture, 8).is_known);
    picture.methods[0].summary.infinite_variance = true;
    EXPECT_FALSE(verdict_on(picture, 8).is_known);
}

TEST(StudyVerdict, NamesTheErrorThatSamplesDoNotRemove) {
    StudiedPicture picture;
    picture.methods = {studied(0, 5e-6, 1e-7, 1.0)};
    picture.methods[0].summary.points.back().bias_squared = {4e-6, 1e-7};
    picture.methods[0].summary.points.back().biased = true;
    EXPECT_NEAR(verdict_on(picture, 8).own_error.value(), 0.002, 1e-15);
}

// For many repeats t is 1.96: (1.96 · 0.4 / (2 · 0.01))² = 1536.6.
TEST(Repeats, AreAsManyAsTheIntervalTakes) {
    EXPECT_NEAR(static_cast<double>(repeats_for(0.4, 0.01)), 1537.0, 4.0);
    EXPECT_EQ(repeats_for(0.0, 0.01), 2u);
    for (const double half_width : {0.3, 0.1, 0.03}) {
        const std::size_t n = repeats_for(0.2, half_width);
        const auto half = [](std::size_t repeats) {
            const auto r = static_cast<double>(repeats);
            return 0.5 * student_t_quantile(0.95, r - 1.0) * 0.2 / std::sqrt(r);
        };
        EXPECT_LE(half(n), half_width);
        if (n > 2) {
            EXPECT_GT(half(n - 1), half_width);
        }
    }
}

}  // namespace neumann::verdict_test
