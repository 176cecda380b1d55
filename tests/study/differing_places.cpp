// Where pictures differ, with errors that are made up.
#include "operators/experiments/study/differing_places.h"

#include <gtest/gtest.h>

namespace neumann::differing_places_test {

Image grey(int width, int height, double value) {
    Image image(width, height);
    for (Rgb& p : image.pixels) p = Rgb(value);
    return image;
}

TEST(DifferingPlaces, AreWhereMethodsDiffer) {
    const Image reference = grey(60, 48, 1.0);
    Image a = grey(60, 48, 0.1), b = a;
    // The same large error in both is no difference.
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) a.at(x, y) = b.at(x, y) = Rgb(9.0);
    for (int y = 30; y < 38; ++y)
        for (int x = 40; x < 48; ++x) b.at(x, y) = Rgb(0.5);
    for (int y = 20; y < 28; ++y)
        for (int x = 8; x < 16; ++x) a.at(x, y) = Rgb(0.3);
    EXPECT_EQ(differing_places({a, b}, reference, 2), (std::vector<Crop>{{40, 30, 8, 8}, {8, 20, 8, 8}}));
    EXPECT_TRUE(differing_places({a, a}, reference, 2).empty());
    EXPECT_EQ(differing_places({a}, reference, 1), (std::vector<Crop>{{0, 0, 8, 8}}));
}

// The same absolute error counts more where it is dark.
TEST(DifferingPlaces, WeighErrorsAsRelMseDoes) {
    Image reference = grey(32, 16, 1.0), a = grey(32, 16, 0.0), b = a;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) reference.at(x, y) = Rgb(0.01);
    for (const int x : {4, 20})
        for (int dy = 0; dy < 8; ++dy)
            for (int dx = 0; dx < 8; ++dx) b.at(x + dx, 4 + dy) = Rgb(0.1);
    EXPECT_EQ(differing_places({a, b}, reference, 2), (std::vector<Crop>{{4, 4, 8, 8}, {20, 4, 8, 8}}));
}

TEST(DifferingPlaces, DoNotOverlapAndFitSmallPictures) {
    const Image reference = grey(6, 5, 1.0);
    Image a = grey(6, 5, 0.0);
    a.at(5, 0) = Rgb(1.0);
    EXPECT_EQ(differing_places({a}, reference, 3), (std::vector<Crop>{{1, 0, 5, 5}}));
}

// Errors of +1 and −3: √((1 + 9)/2 − v).
TEST(ErrorMap, IsTheRootMeanSquareWithoutTheNoiseOfTheReference) {
    const Estimate reference{grey(2, 1, 5.0), grey(2, 1, 1.0)};
    const Image map = error_map(
        2, [](std::size_t j) { return grey(2, 1, j == 0 ? 6.0 : 2.0); }, reference);
    EXPECT_NEAR(map.pixels[1].g, 2.0, 1e-15);
    EXPECT_EQ(error_map(
                  1, [](std::size_t) { return grey(2, 1, 5.5); }, reference)
                  .pixels[0]
                  .r,
              0.0);
}

TEST(ErrorMap, Cropped) {
    Image picture(3, 2);
    picture.at(2, 1) = Rgb(7.0);
    const Image part = cropped(picture, {1, 1, 2, 1});
    EXPECT_EQ(part.width, 2);
    EXPECT_EQ(part.height, 1);
    EXPECT_EQ(part.at(1, 0).b, 7.0);
    EXPECT_TRUE(cropped(Estimate{picture, {}}, {0, 0, 1, 1}).standard_error.pixels.empty());
}

}  // namespace neumann::differing_places_test
