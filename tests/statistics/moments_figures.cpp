// Figures for whole pictures, and Student's t, against values worked out by hand or printed in tables.
#include "operators/statistics/picture_statistics.h"
#include "operators/statistics/student_t.h"

#include "core/base/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace neumann::moments_figures_test {

constexpr double infinity = std::numeric_limits<double>::infinity();

Image picture(std::vector<Rgb> pixels) {
    Image image(static_cast<int>(pixels.size()), 1);
    image.pixels = std::move(pixels);
    return image;
}

// Means over channels 2 and 5; errors over channels .3 and .4, so √(.3² + .4²)/2 = .25. Welch and Satterthwaite: 7 · (.09 + .16)² /
// (.09² + .16²).
TEST(PictureMean, ByHand) {
    const Estimate e{picture({{1, 2, 3}, {4, 5, 6}}), picture({{.1, .3, .5}, {.4, .4, .4}}), 7.0};
    const MeanWithError mean = picture_mean(e);
    EXPECT_NEAR(mean.mean, 3.5, 1e-15);
    EXPECT_NEAR(mean.standard_error, 0.25, 1e-15);
    EXPECT_NEAR(mean.degrees_of_freedom, 7.0 * 0.0625 / (0.0081 + 0.0256), 1e-12);
    EXPECT_NEAR(mean.interval(), 0.25 * student_t_quantile(0.95, mean.degrees_of_freedom), 1e-15);
}

TEST(PictureMean, OfEquallyUncertainPixelsHasAllTheirDegreesOfFreedom) {
    const Estimate e{picture(std::vector<Rgb>(100, Rgb(2.0))), picture(std::vector<Rgb>(100, Rgb(0.5))), 3.0};
    EXPECT_NEAR(picture_mean(e).standard_error, 0.05, 1e-15);
    EXPECT_NEAR(picture_mean(e).degrees_of_freedom, 300.0, 1e-9);
    // One pixel that makes all of the error: its own.
    Estimate one = e;
    one.standard_error = picture(std::vector<Rgb>(100, Rgb(0.0)));
    one.standard_error.pixels[17] = Rgb(1.0);
    EXPECT_NEAR(picture_mean(one).degrees_of_freedom, 3.0, 1e-12);
}

TEST(PictureMean, WithoutErrorOrWithAnUnknownOne) {
    Estimate e{picture({Rgb(1.0), Rgb(3.0)}), picture({Rgb(0.0), Rgb(0.0)}), 7.0};
    EXPECT_EQ(picture_mean(e).mean, 2.0);
    EXPECT_EQ(picture_mean(e).standard_error, 0.0);
    EXPECT_EQ(picture_mean(e).interval(), 0.0);
    e.standard_error = picture({Rgb(infinity), Rgb(infinity)});
    e.degrees_of_freedom = 0.0;
    EXPECT_EQ(picture_mean(e).standard_error, infinity);
    EXPECT_EQ(picture_mean(e).interval(), infinity);
    EXPECT_EQ(picture_mean({}).standard_error, 0.0);
}

TEST(PictureMean, BrightnessDoesNotMatter) {
    const Estimate e{picture({{1, 2, 3}, {4, 5, 6}}), picture({{.1, .3, .5}, {.4, .4, .4}}), 7.0};
    for (const int exponent : {-900, 900}) {
        Estimate scaled = e;
        for (Image* image : {&scaled.mean, &scaled.standard_error})
            for (Rgb& p : image->pixels) p *= std::ldexp(1.0, exponent);
        EXPECT_EQ(picture_mean(scaled).standard_error, std::ldexp(picture_mean(e).standard_error, exponent));
        EXPECT_EQ(picture_mean(scaled).degrees_of_freedom, picture_mean(e).degrees_of_freedom);
        EXPECT_NEAR(relative_standard_error(scaled), relative_standard_error(e), 1e-15);
    }
}

// Σ SE² = 14 · .01 = .14, Σ mean² = 14.
TEST(RelativeStandardError, ByHand) {
    EXPECT_NEAR(relative_standard_error({picture({{1, 2, 3}}), picture({{.1, .2, .3}}), 3.0}), 0.1, 1e-15);
    EXPECT_NEAR(relative_standard_error({picture({{3, 0, 0}, {0, 4, 0}}), picture({{0, 0, 1}, {1, 1, 1}}), 3.0}), 0.4, 1e-15);
    EXPECT_EQ(relative_standard_error({picture({Rgb(0.0)}), picture({Rgb(0.0)}), 3.0}), 0.0);
    EXPECT_EQ(relative_standard_error({picture({Rgb(2.0)}), picture({Rgb(0.0)}), 3.0}), 0.0);
}

// Differences 1, −2, 2 and 0, 0, 0; √9 / √(16 + 16 + 4).
TEST(RelativeError, ByHand) {
    EXPECT_NEAR(relative_error(picture({{5, 2, 4}, {0, 0, 0}}), picture({{4, 4, 2}, {0, 0, 0}})), 0.5, 1e-15);
    EXPECT_EQ(relative_error(picture({Rgb(0.0)}), picture({Rgb(0.0)})), 0.0);
    EXPECT_EQ(relative_error(picture({Rgb(1.0)}), picture({Rgb(0.0)})), infinity);
    EXPECT_NEAR(relative_error(picture({Rgb(3e-300)}), picture({Rgb(2e-300)})), 0.5, 1e-15);
    EXPECT_THROW(relative_error(picture({Rgb(1.0)}), picture({Rgb(1.0), Rgb(1.0)})), InputError);
}

// Two-sided, as printed in any table (Abramowitz and Stegun 26.10).
TEST(StudentT, IsThatOfTheTables) {
    const double table[][3] = {{.95, 1, 12.706}, {.95, 2, 4.303},   {.95, 3, 3.182}, {.95, 7, 2.365},  {.95, 10, 2.228},
                               {.95, 31, 2.040}, {.95, 120, 1.980}, {.99, 3, 5.841}, {.99, 30, 2.750}, {.90, 5, 2.015}};
    for (const auto& [confidence, df, t] : table) EXPECT_NEAR(student_t_quantile(confidence, df), t, 5.1e-4) << df;
    EXPECT_NEAR(student_t_quantile(0.95, 1e9), 1.959964, 1e-6);
    EXPECT_NEAR(student_t_quantile(0.95, infinity), 1.959964, 1e-6);
    const double between = student_t_quantile(0.95, 7.5);  // Welch's need not be whole
    EXPECT_LT(between, 2.365);
    EXPECT_GT(between, 2.306);
}
TEST(StudentT, WithoutDegreesOfFreedomTheIntervalIsInfinite) {
    EXPECT_EQ(student_t_quantile(0.95, 0.0), infinity);
    EXPECT_EQ(student_t_quantile(0.95, std::numeric_limits<double>::quiet_NaN()), infinity);
}

}  // namespace neumann::moments_figures_test
