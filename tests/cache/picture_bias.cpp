// The bias that pictures of a cache state: three times the root mean square of the differences nearby.
#include "operators/render/report/picture_bias.h"

#include "operators/render/from_paths/cache_sampler.h"
#include "operators/render/from_paths/photon_sampler.h"

#include <gtest/gtest.h>

#include <cmath>

namespace neumann::picture_bias_test {

const TwoRadii cache = *CachePaths(nullptr).two_radii();

TEST(PictureBias, OfTheSameDifferenceEverywhereIsThreeTimesIt) {
    for (const auto& [width, height] : {std::pair{40, 33}, std::pair{3, 50}, std::pair{1, 1}}) {
        Image difference(width, height);
        for (std::size_t i = 0; i < difference.pixels.size(); ++i)
            difference.pixels[i] = Rgb(0.5, -0.25, 0.0) * (i % 2 ? 1.0 : -1.0);
        for (const Rgb& bias : stated_bias(cache, difference).pixels) {
            EXPECT_NEAR(bias.r, 1.5, 1e-12);
            EXPECT_NEAR(bias.g, 0.75, 1e-12);
            EXPECT_NEAR(bias.b, 0.0, 1e-7);
        }
    }
}

// 32 pixels across: two to each side, and those within the picture count.
TEST(PictureBias, OfOnePixelIsSpreadOverItsNeighbourhood) {
    Image difference(32, 48);
    difference.at(10, 20) = difference.at(0, 0) = Rgb(1.0);
    const Image bias = stated_bias(cache, difference);
    EXPECT_NEAR(bias.at(10, 20).g, 3.0 / 5.0, 1e-12);
    EXPECT_NEAR(bias.at(12, 18).g, 3.0 / 5.0, 1e-12);
    EXPECT_NEAR(bias.at(13, 20).g, 0.0, 1e-7);
    EXPECT_NEAR(bias.at(0, 0).g, 3.0 / 3.0, 1e-12);
    EXPECT_NEAR(bias.at(2, 0).g, 3.0 / std::sqrt(15.0), 1e-12);
}

TEST(PictureBias, OfPhotonMapsIsThatOfThePixel) {
    Image difference(5, 4);
    difference.at(1, 2) = Rgb(-0.1);
    const Image bias = stated_bias(*PhotonPaths(nullptr).two_radii(), difference);
    EXPECT_NEAR(bias.at(1, 2).g, 0.1 / (1.0 - std::sqrt(0.5)), 1e-12);
    EXPECT_EQ(bias.at(1, 1).g, 0.0);
}

}  // namespace neumann::picture_bias_test
