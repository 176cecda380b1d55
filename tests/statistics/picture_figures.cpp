// What is made of finished pictures: fewer pixels, and the rate at which bounces fall.
#include "operators/statistics/decay_fit.h"
#include "operators/statistics/reduced_picture.h"

#include <gtest/gtest.h>
#include <cmath>
#include <vector>

namespace neumann::picture_figures_test {

Estimate five_by_three() {
    Estimate picture{Image(5, 3), Image(5, 3), 7.0, Image(5, 3)};
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 5; ++x) {
            picture.mean.at(x, y) = Rgb(x + 10.0 * y, 1.0, -2.0);
            picture.standard_error.at(x, y) = Rgb(3.0, x, 0.0);
            picture.discretisation.at(x, y) = Rgb(y, 0.5, 0.0);
        }
    return picture;
}

// The picture as a whole has the same mean and the same error before and after, where all boxes are full.
TEST(PictureFigures, ReducedPicturesAreMeansOfBoxes) {
    const Estimate r = reduced(five_by_three(), 2);
    ASSERT_EQ(r.mean.width, 3);
    ASSERT_EQ(r.mean.height, 2);
    EXPECT_EQ(r.mean.at(1, 0), Rgb((2 + 3 + 12 + 13) / 4.0, 1.0, -2.0));
    EXPECT_EQ(r.mean.at(2, 0), Rgb((4 + 14) / 2.0, 1.0, -2.0));
    EXPECT_EQ(r.mean.at(2, 1), Rgb(24.0, 1.0, -2.0));
    EXPECT_DOUBLE_EQ(r.standard_error.at(1, 0).r, std::sqrt(4 * 9.0) / 4);
    EXPECT_DOUBLE_EQ(r.standard_error.at(1, 0).g, std::sqrt(4.0 + 9 + 4 + 9) / 4);
    EXPECT_DOUBLE_EQ(r.standard_error.at(2, 0).r, std::sqrt(2 * 9.0) / 2);
    EXPECT_EQ(r.discretisation.at(0, 0), Rgb(0.5, 0.5, 0.0));
    EXPECT_EQ(r.degrees_of_freedom, 7.0);

    Estimate together = five_by_three();
    together.pixels_are_independent = false;
    EXPECT_DOUBLE_EQ(reduced(together, 2).standard_error.at(1, 0).g, 2.5);
    EXPECT_EQ(reduced(together, 1).mean.pixels, together.mean.pixels);
}

TEST(PictureFigures, DecayOfAGeometricSeriesIsItsRatio) {
    std::vector<MeanWithError> bounces;
    for (int i = 0; i < 12; ++i) bounces.push_back({5.0 * std::pow(0.7, i) + (i < 6 ? 1.0 : 0.0), 0.01 * std::pow(0.9, i), 9.0});
    const auto fit = fit_decay(bounces);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->ratio, 0.7, 1e-12);
    EXPECT_NEAR(std::exp(fit->log_at_0), 5.0, 1e-11);
    EXPECT_EQ(fit->first, 6u);
    EXPECT_EQ(fit->last, 11u);

    // What is lost in noise or zero has no say.
    bounces[9] = {100.0, 51.0, 9.0};
    bounces[10].mean = 0.0;
    bounces[11].mean = -1.0;
    EXPECT_NEAR(fit_decay(bounces)->ratio, 0.7, 1e-12);
    EXPECT_EQ(fit_decay(bounces)->last, 8u);
    bounces.resize(2);
    EXPECT_FALSE(fit_decay(bounces));
}

// By hand: points (2, 0), (3, log 2) and (4, 0) with relative errors 0.1, 0.2 and 0.1 weigh 1, 1/4 and 1; the slope is 0 by
// symmetry and the level log 2 · (1/4) / (9/4).
TEST(PictureFigures, DecayWeighsBouncesByTheirErrors) {
    const std::vector<MeanWithError> bounces{{9, 1, 9}, {9, 1, 9}, {1, 0.1, 9}, {2, 0.4, 9}, {1, 0.1, 9}};
    const auto fit = fit_decay(bounces);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->ratio, 1.0, 1e-12);
    EXPECT_NEAR(fit->log_at_0, std::log(2.0) / 9.0, 1e-12);
}

TEST(PictureFigures, DecayOfExactBounces) {
    const std::vector<MeanWithError> bounces{{8, 0, 3}, {4, 0, 3}, {2, 0, 3}, {1, 0, 3}};
    EXPECT_NEAR(fit_decay(bounces)->ratio, 0.5, 1e-12);
}

}  // namespace neumann::picture_figures_test
