// Intervals for differences of means: by hand, and how often they hold the truth.
#include "operators/statistics/metrics.h"

#include <gtest/gtest.h>
#include <cmath>
#include <limits>
#include <random>

namespace neumann::metrics_means_test {

Estimate constant(int pixels, const Rgb& mean, const Rgb& error) {
    Estimate e{Image(pixels, 1), Image(pixels, 1)};
    for (Rgb& p : e.mean.pixels) p = mean;
    for (Rgb& p : e.standard_error.pixels) p = error;
    return e;
}

TEST(MetricsMeans, HandComputedInterval) {
    // Four pixels, errors 0.3 and 0.4: each difference has 0.5, their mean 0.25.
    const Estimate a = constant(4, Rgb(1, 2, 3), Rgb(0.3)), b = constant(4, Rgb(1.0), Rgb(0.4));
    const MeanDifferences d = compare_means({a, 3.0}, {b, 3.0});
    EXPECT_NEAR(d.channel[2].difference, 2.0, 1e-15);
    EXPECT_NEAR(d.channel[2].standard_error, 0.25, 1e-15);
    // Welch and Satterthwaite: (4·0.25)² / (4 (0.3⁴ + 0.4⁴)/3) = 3/(4·0.0337).
    EXPECT_NEAR(d.channel[2].degrees_of_freedom, 3.0 / (4.0 * 0.0337), 1e-11);
    EXPECT_NEAR(d.all.mean, 2.0, 1e-15);
    EXPECT_NEAR(d.all.standard_error, 0.25, 1e-15);
}

TEST(MetricsMeans, StudentsFactorOfOnePixel) {
    // P(|T| ≤ 3.182446) = 0.95 with three degrees of freedom, P(|Z| ≤ 1.959964) with as many as one likes.
    const Estimate a = constant(1, Rgb(1.0), Rgb(0.5));
    const Estimate exact{Image(1, 1), {}};
    EXPECT_NEAR(compare_means({a, 3.0}, {exact}).all.half_width, 0.5 * 3.182446, 1e-6);
    EXPECT_NEAR(compare_means({a}, {exact, 3.0}).all.half_width, 0.5 * 1.959964, 1e-6);
}

// Errors of means that are known count in place of all others, unless pixels are left out.
TEST(MetricsMeans, KnownErrorsOfMeans) {
    Estimate a = constant(4, Rgb(1, 2, 3), Rgb(0.3));
    a.pixels_are_independent = false;
    const PictureMeans known{{{1.0, 0.01, 3.0}, {2.0, 0.02, 3.0}, {3.0, 0.03, 3.0}}, {2.0, 0.03, 7.0}};
    const Estimate b = constant(4, Rgb(1.0), Rgb(0.08));  // 0.04 of the mean
    EXPECT_NEAR(compare_means({a, 3.0}, {b}).all.standard_error, std::hypot(0.3, 0.04), 1e-15);
    const MeanDifferences d = compare_means({a, 3.0, &known}, {b});
    EXPECT_NEAR(d.channel[2].standard_error, 0.05, 1e-15);
    EXPECT_NEAR(d.all.standard_error, 0.05, 1e-15);
    EXPECT_NEAR(d.all.degrees_of_freedom, 7.0 * std::pow(0.05 / 0.03, 4), 1e-11);
    a.mean.at(0, 0).r = std::numeric_limits<double>::quiet_NaN();
    EXPECT_GT(compare_means({a, 3.0, &known}, {b}).all.standard_error, 0.3);
}

TEST(MetricsMeans, NoErrorAndUnknownError) {
    const Estimate sure = constant(4, Rgb(1.0), Rgb(0.0));
    const MeanDifference none = compare_means({sure, 3.0}, {sure, 3.0}).all;
    EXPECT_EQ(none.half_width, 0.0);
    const Estimate unknown = constant(4, Rgb(1.0), Rgb(std::numeric_limits<double>::infinity()));
    EXPECT_EQ(compare_means({unknown, 0.0}, {sure, 3.0}).all.half_width, std::numeric_limits<double>::infinity());
}

TEST(MetricsMeans, BrightnessDoesNotMatter) {
    const Estimate one = constant(4, Rgb(1.0), Rgb(0.3));
    for (const double s : {1e-90, 1e90}) {
        const Estimate other = constant(4, Rgb(s), Rgb(0.3 * s));
        EXPECT_NEAR(compare_means({other, 3.0}, {other, 3.0}).all.half_width / s,
                    compare_means({one, 3.0}, {one, 3.0}).all.half_width, 1e-14);
    }
}

TEST(MetricsMeans, ExpectedRmse) {
    EXPECT_NEAR(expected_rmse(constant(5, Rgb(1.0), Rgb(0.3)), constant(5, Rgb(2.0), Rgb(0.4))), 0.5, 1e-15);
    EXPECT_EQ(expected_rmse({Image(2, 2), {}}, {Image(2, 2), {}}), 0.0);
}

// 4000 intervals of pictures of 16 pixels, each from 8 normal samples: between 93.5% and 96.5% hold the truth (4 standard
// deviations of a count with 95%: 1.4%; false alarms 1e-4).
TEST(MetricsMeans, IntervalsHoldTheTruth) {
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    constexpr int runs = 4000, pixels = 16, samples = 8;
    const Estimate truth{Image(pixels, 1), {}};
    int held = 0;
    for (int run = 0; run < runs; ++run) {
        Estimate e = constant(pixels, Rgb(0.0), Rgb(0.0));
        for (int i = 0; i < pixels; ++i) {
            double sum = 0.0, squares = 0.0;
            for (int s = 0; s < samples; ++s) {
                const double x = normal(random) * (1.0 + i);
                sum += x;
                squares += x * x;
            }
            const double mean = sum / samples, variance = (squares - sum * mean) / (samples - 1);
            e.mean.at(i, 0) = Rgb(mean);
            e.standard_error.at(i, 0) = Rgb(std::sqrt(variance / samples));
        }
        const MeanDifference d = compare_means({e, samples - 1.0}, {truth}).all;
        if (std::abs(d.difference) <= d.half_width) ++held;
    }
    EXPECT_GT(held, 0.935 * runs);
    EXPECT_LT(held, 0.965 * runs);
}

}  // namespace neumann::metrics_means_test
