#include "operators/experiments/study/error_slope.h"

#include "tests/physics/seed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace neumann::error_slope_test {

std::vector<ErrorPoint> power_law(double exponent, double mse_error = 0.01) {
    std::vector<ErrorPoint> points;
    for (const double t : {1.0, 2.0, 4.0, 8.0}) {
        const double mse = 0.04 * std::pow(t, 2.0 * exponent);
        points.push_back({t, 0.0, mse, mse_error * mse});
    }
    return points;
}

TEST(ErrorSlope, PowerLaws) {
    for (const double exponent : {-0.5, -0.75, -1.0}) {
        const auto slope = error_slope(power_law(exponent));
        ASSERT_TRUE(slope);
        EXPECT_NEAR(slope->slope, exponent, 1e-12);
        EXPECT_EQ(slope->points, 4u);
        // Equal weights: σ_y = 0.005, Σ (x − x̄)² = 5 ln²2.
        EXPECT_NEAR(slope->standard_error, 0.005 / (std::sqrt(5.0) * std::log(2.0)), 1e-12);
        EXPECT_NEAR(slope->half_width, 1.959964 * slope->standard_error, 1e-6);
    }
}

// An error that all MSE have in common: δ Σ c / (2 MSE).
TEST(ErrorSlope, SharedError) {
    const auto points = power_law(-0.5);
    const double step = std::log(2.0), xx = 5.0 * step * step;
    double change = 0.0;
    for (std::size_t i = 0; i < 4; ++i) change += (static_cast<double>(i) - 1.5) * step / xx / (2.0 * points[i].mse);
    const double alone = error_slope(points)->standard_error, shared = 1e-4;
    EXPECT_NEAR(error_slope(points, shared)->standard_error, std::hypot(alone, change * shared), 1e-12);
}

TEST(ErrorSlope, PointsWithoutMeaningAreLeftOut) {
    auto points = power_law(-0.5);
    points[3].mse = -1e-3;
    EXPECT_EQ(error_slope(points)->points, 3u);
    points[2].mse_error = 0.6 * points[2].mse;
    EXPECT_EQ(error_slope(points)->points, 2u);
    points[1].mse_error = 0.0;  // not known
    EXPECT_FALSE(error_slope(points));
    EXPECT_FALSE(error_slope({}));
    auto same = power_law(-0.5);
    for (ErrorPoint& p : same) p.work = 1.0;
    EXPECT_FALSE(error_slope(same));
}

// The interval holds the exponent in at least 95% of 2000 made-up studies, whether the scatter is in the error or in the time: 4.5
// binomial standard deviations are 2.2%, false alarm 7e-6 each. Widening by the scatter of four points adds to it.
TEST(ErrorSlope, Coverage) {
    std::mt19937_64 random(physics::fixed_seed);
    std::normal_distribution<double> normal;
    constexpr int studies = 2000;
    struct Case {
        double error, time;
    };
    for (const Case& c : {Case{0.05, 0.0}, Case{0.02, 0.05}}) {
        int held = 0;
        for (int i = 0; i < studies; ++i) {
            auto points = power_law(-0.5, 2.0 * c.error);
            for (ErrorPoint& p : points) {
                p.mse *= std::exp(2.0 * c.error * normal(random));
                p.mse_error = 2.0 * c.error * p.mse;
                p.work_error = c.time * p.work;
                p.work *= std::exp(c.time * normal(random));
            }
            const auto slope = error_slope(points);
            held += std::abs(slope->slope + 0.5) <= slope->half_width;
        }
        EXPECT_GE(held, (0.95 - 0.022) * studies) << c.error << " " << c.time;
        EXPECT_LE(held, 0.995 * studies);
    }
}

TEST(WorkToError, BetweenPoints) {
    const auto points = power_law(-0.5);  // RMSE 0.2, 0.141, 0.1, 0.0707
    EXPECT_NEAR(work_to_error(points, 0.1)->work, 4.0, 1e-12);
    EXPECT_NEAR(work_to_error(points, 0.2 / std::sqrt(3.0))->work, 3.0, 1e-12);
    EXPECT_FALSE(work_to_error(points, 0.1)->below);
    EXPECT_TRUE(work_to_error(points, 0.3)->below);
    EXPECT_EQ(work_to_error(points, 0.3)->work, 1.0);
    EXPECT_FALSE(work_to_error(points, 0.05));
    auto negative = points;
    negative[1].mse = -1e-4;
    EXPECT_TRUE(work_to_error(negative, 0.1)->below);
    EXPECT_EQ(work_to_error(negative, 0.1)->work, 2.0);
}

}  // namespace neumann::error_slope_test
