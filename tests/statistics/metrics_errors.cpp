// The error metrics against values worked out by hand.
#include "core/base/error.h"
#include "operators/statistics/metrics.h"

#include <gtest/gtest.h>
#include <cmath>
#include <limits>

namespace neumann::metrics_errors_test {

Image row(const std::vector<Rgb>& pixels) {
    Image image(static_cast<int>(pixels.size()), 1);
    image.pixels = pixels;
    return image;
}

TEST(Metrics, HandComputedValues) {
    // x − r: 1 0 0, 0 0 −2; mean r = 2, mean x = 11/6.
    const Metrics m = compare(row({Rgb(2, 2, 1), Rgb(3, 1, 2)}), row({Rgb(1, 2, 1), Rgb(3, 1, 4)}));
    EXPECT_NEAR(m.rmse, std::sqrt(5.0 / 6.0), 1e-15);
    EXPECT_NEAR(m.rel_mse, (1.0 / (1.0 + 0.04) + 4.0 / (16.0 + 0.04)) / 6.0, 1e-15);
    EXPECT_NEAR(m.mape, (1.0 / (1.0 + 0.02) + 2.0 / (4.0 + 0.02)) / 6.0, 1e-15);
    const double floor = 0.01 * (2.0 + 11.0 / 6.0);
    EXPECT_NEAR(m.smape, (2.0 / (3.0 + floor) + 4.0 / (6.0 + floor)) / 6.0, 1e-15);
    EXPECT_EQ(m.max_error, 2.0);
    EXPECT_NEAR(m.mean, 11.0 / 6.0, 1e-15);
    EXPECT_NEAR(m.reference_mean, 2.0, 1e-15);
    EXPECT_NEAR(m.mean_difference, -1.0 / 6.0, 1e-15);
    EXPECT_EQ(m.pixels, 2U);
    EXPECT_EQ(m.not_finite, 0U);
}

TEST(Metrics, EqualPicturesHaveNoErrorEvenBlackOnes) {
    for (const Image& image : {Image(3, 3), row({Rgb(1, 2, 3)})}) {
        const Metrics m = compare(image, image);
        for (const double value : {m.rmse, m.rel_mse, m.mape, m.smape, m.max_error, m.mean_difference}) EXPECT_EQ(value, 0.0);
    }
}

TEST(Metrics, ABlackReferenceMakesRelativeErrorsInfinite) {
    const Metrics m = compare(row({Rgb(1.0)}), Image(1, 1));
    EXPECT_EQ(m.rmse, 1.0);
    EXPECT_EQ(m.rel_mse, std::numeric_limits<double>::infinity());
    EXPECT_EQ(m.mape, std::numeric_limits<double>::infinity());
    EXPECT_NEAR(m.smape, 2.0 / 1.01, 1e-15);
}

TEST(Metrics, BrightnessDoesNotMatter) {
    const auto scaled = [](double s) {
        return compare(row({Rgb(2, 2, 1) * s, Rgb(3, 1, 2) * s}), row({Rgb(1, 2, 1) * s, Rgb(3, 1, 4) * s}));
    };
    const Metrics one = scaled(1.0);
    for (const double s : {1e-30, 1e30}) {
        const Metrics m = scaled(s);
        EXPECT_NEAR(m.rmse / s, one.rmse, 1e-14);
        EXPECT_NEAR(m.rel_mse, one.rel_mse, 1e-14);
        EXPECT_NEAR(m.mape, one.mape, 1e-14);
        EXPECT_NEAR(m.smape, one.smape, 1e-14);
    }
}

TEST(Metrics, WhatIsNotFiniteIsCountedAndLeftOut) {
    const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
    const Metrics m = compare(row({Rgb(2.0), Rgb(0, nan, 0), Rgb(1.0)}), row({Rgb(1.0), Rgb(1.0), Rgb(infinity, 0, 0)}));
    EXPECT_EQ(m.not_finite, 2U);
    EXPECT_EQ(m.pixels, 1U);
    EXPECT_EQ(m.rmse, 1.0);
    EXPECT_TRUE(std::isnan(compare(row({Rgb(nan)}), row({Rgb(1.0)})).rmse));
}

TEST(Metrics, SizesMustAgree) {
    try {
        compare(Image(64, 48), Image(32, 48));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "64×48 pixels against 32×48");
    }
}

}  // namespace neumann::metrics_errors_test
