#include "operators/experiments/study/reference_choice.h"

#include <gtest/gtest.h>

#include <limits>

namespace neumann::reference_choice_test {

constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(ReferenceChoice, TheOneWhoseWorstBounceIsLessBehind) {
    // Four times worse in one bounce, and eight times better in another.
    const VarianceRatio ratio = variance_ratio(std::vector{4.0, 1.0, 1.0}, std::vector{1.0, 1.0, 8.0});
    EXPECT_EQ(ratio.most, 4.0);
    EXPECT_EQ(ratio.most_bounce, 0u);
    EXPECT_EQ(ratio.least, 0.125);
    EXPECT_EQ(ratio.least_bounce, 2u);
    EXPECT_TRUE(ratio.takes_first());
    EXPECT_FALSE(variance_ratio(std::vector{1.0, 1.0, 8.0}, std::vector{4.0, 1.0, 1.0}).takes_first());
    // One that is better everywhere.
    EXPECT_TRUE(variance_ratio(std::vector{1.0, 1.0}, std::vector{2.0, 3.0}).takes_first());
    EXPECT_FALSE(variance_ratio(std::vector{2.0, 3.0}, std::vector{1.0, 1.0}).takes_first());
}

TEST(ReferenceChoice, InfiniteVarianceLoses) {
    EXPECT_FALSE(variance_ratio(std::vector{infinite, 1.0}, std::vector{1.0, 1e9}).takes_first());
    EXPECT_TRUE(variance_ratio(std::vector{1e9, 1.0}, std::vector{1.0, infinite}).takes_first());
    // In the same bounce it says nothing, in different ones the first is as good as the second.
    EXPECT_FALSE(variance_ratio(std::vector{infinite, 2.0}, std::vector{infinite, 1.0}).takes_first());
    EXPECT_TRUE(variance_ratio(std::vector{infinite, 2.0}, std::vector{1.0, infinite}).takes_first());
}

// A picture of one pixel.
BounceSeries series(double mean, double standard_error, bool infinite_variance) {
    BounceSeries result;
    Estimate estimate{Image(1, 1), Image(1, 1)};
    estimate.mean.pixels[0] = Rgb(mean);
    estimate.standard_error.pixels[0] = Rgb(standard_error);
    result.term = [estimate](std::size_t) { return estimate; };
    result.report.bounces.resize(1);
    result.report.bounces[0].infinite_variance = infinite_variance;
    result.rays = 1000;
    return result;
}

TEST(ReferenceChoice, VarianceTimesRays) {
    EXPECT_NEAR(variance_times_rays(series(1.0, 0.5, false))[0], 250.0, 1e-9);
    EXPECT_EQ(variance_times_rays(series(1.0, 0.5, true))[0], infinite);
    EXPECT_EQ(variance_times_rays(series(0.0, 0.0, false))[0], infinite);
    // What is exact but for rounding is taken as just that.
    EXPECT_EQ(variance_times_rays(series(2.0, 0.0, false)), variance_times_rays(series(2.0, 1e-9, false)));
}

}  // namespace neumann::reference_choice_test
