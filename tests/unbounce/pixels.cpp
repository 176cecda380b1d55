// Pixels by the operators of the regions, on pictures that are known exactly: T_p = T¹_p + A_p T, with a row A_p for each pixel
// whose mean over a region is the region's row of A.
#include "core/base/error.h"
#include "operators/experiments/unbounce/doubts.h"
#include "tests/unbounce/synthetic.h"

#include <gtest/gtest.h>

namespace neumann::unbounce_pixels_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using synthetic::Room;

// 4×2 regions of 3×4 pixels, whose surface varies by ±40% from pixel to pixel. Green is lit half as much, and blue is black.
class Scene {
public:
    static constexpr int columns = 4, rows = 2, width = 12, height = 8;
    static constexpr double of_channel[] = {1.0, 0.5, 0.0};

    explicit Scene(double reflectance = 0.7) : room(synthetic::random_room(columns * rows, reflectance, 4)) {
        const VectorXd sizes = regions.sizes(columns * rows);
        std::vector<double> sums(columns * rows, 0.0);
        for (std::size_t p = 0; p < regions.of_pixel.size(); ++p) {
            factors.push_back(1.0 + 0.4 * std::sin(1.7 * static_cast<double>(p)));
            sums[static_cast<std::size_t>(regions.of_pixel[p])] += factors.back();
        }
        for (std::size_t p = 0; p < factors.size(); ++p)
            factors[p] *= sizes[regions.of_pixel[p]] / sums[static_cast<std::size_t>(regions.of_pixel[p])];
    }

    Image image(const VectorXd& of_region) const {
        Image result(width, height);
        for (std::size_t p = 0; p < factors.size(); ++p)
            for (int c = 0; c < 3; ++c) result.pixels[p][c] = of_channel[c] * factors[p] * of_region[regions.of_pixel[p]];
        return result;
    }
    LightPictures pictures() const {
        LightPictures result;
        for (int j = 0; j < columns * rows; ++j) result.names.push_back("light " + std::to_string(j));
        result.picture = [this](std::size_t j) { return Estimate{image(room.T.col(static_cast<Eigen::Index>(j))), {}}; };
        return result;
    }

    Regions regions = block_regions(width, height, columns, rows);
    Room room;
    std::vector<double> factors;
};

double largest_difference(const Image& a, const Image& b) {
    double result = 0.0;
    for (std::size_t p = 0; p < a.pixels.size(); ++p) result = std::max(result, max_component(glm::abs(a.pixels[p] - b.pixels[p])));
    return result;
}

TEST(UnbouncePixels, AreExactWhereRegionsAre) {
    const Scene scene;
    const Unbounced found = unbounce(scene.pictures(), scene.regions, nullptr, {.bounces = 5});
    ASSERT_EQ(found.bounces(), 5);
    for (int n = 1; n <= 5; ++n) {
        const auto term = static_cast<std::size_t>(n - 1);
        const VectorXd expected = scene.room.term(n, scene.room.ones());
        EXPECT_LT(largest_difference(found.terms[term].mean, scene.image(expected)), 1e-12);
        const MeanWithError& mean = found.means[term].channel[0];
        EXPECT_NEAR(mean.mean, expected.mean(), 1e-12);
        EXPECT_NEAR(found.means[term].all.mean, expected.mean() / 2.0, 1e-12);
    }
    EXPECT_TRUE(found.channels[2].lights.empty()) << "blue is black";
    EXPECT_TRUE(doubts_about(found, scene.pictures().names).empty());
}

TEST(UnbouncePixels, DirectPicturesAreAnotherWay) {
    const Scene scene;
    LightPictures pictures = scene.pictures();
    pictures.direct = [&](std::size_t j) {
        VectorXd direct = VectorXd::Zero(8);
        direct[static_cast<Eigen::Index>(j)] = scene.room.direct[static_cast<Eigen::Index>(j)];
        return Estimate{scene.image(direct), {}};
    };
    const Unbounced found = unbounce(pictures, scene.regions, nullptr, {.bounces = 3, .with_direct = true});
    for (int n = 1; n <= 3; ++n)
        EXPECT_LT(largest_difference(found.terms[static_cast<std::size_t>(n - 1)].mean,
                                     scene.image(scene.room.term(n, scene.room.ones()))),
                  1e-12);
}

TEST(UnbouncePixels, APictureOfItsOwn) {
    const Scene scene;
    const VectorXd x = VectorXd::LinSpaced(8, 1.0, 0.0);
    const Estimate picture{scene.image(scene.room.T * x), {}};
    const Unbounced found = unbounce(scene.pictures(), scene.regions, &picture, {.bounces = 3});
    Image sum(scene.width, scene.height);
    for (int n = 1; n <= 3; ++n) {
        const Image& term = found.terms[static_cast<std::size_t>(n - 1)].mean;
        EXPECT_LT(largest_difference(term, scene.image(scene.room.term(n, x))), 1e-12);
        for (std::size_t p = 0; p < sum.pixels.size(); ++p) sum.pixels[p] += term.pixels[p];
    }
    for (std::size_t p = 0; p < sum.pixels.size(); ++p) sum.pixels[p] += found.rest.pixels[p];
    EXPECT_LT(largest_difference(sum, picture.mean), 1e-12);
}

TEST(UnbouncePixels, RegionsAreFoundByTheirLights) {
    const Scene scene(0.5);
    EXPECT_EQ(brightest_regions(scene.pictures()).of_pixel, scene.regions.of_pixel);
}

// What is merged has a region's links to itself: the difference tells the error, here of a room whose terms are known.
TEST(UnbouncePixels, MergedRegionsTellTheErrorOfRegions) {
    EXPECT_EQ(merged_by_four(3, 3), (std::vector<int>{0, 0, 1, 0, 0, 1, 2, 2, 3}));
    Scene scene;
    const int m = 8;
    scene.room = Room(MatrixXd::Constant(m, m, 0.7 / m), VectorXd::Ones(m));  // a sphere
    const Unbounced found = unbounce(scene.pictures(), scene.regions, nullptr, {.bounces = 3, .merged = merged_by_four(4, 2)});
    // (m − 1)/(m − ρ) ρ from bounce to bounce, with m = 8 and 2 (tests/unbounce/cancellation.cpp), in two channels, half as bright
    // in one.
    for (int n = 1; n <= 3; ++n) {
        const auto of = [n](double parts) { return std::pow(0.7 * (parts - 1.0) / (parts - 0.7), n - 1) / (1.0 - 0.7 / parts); };
        EXPECT_NEAR(found.discretisation[static_cast<std::size_t>(n - 1)], std::abs(of(8.0) - of(2.0)) / 2.0, 1e-12);
    }
}

// The error of a pixel: 200 repeats of normal errors; it may be too large by that of its region, which is 1/√12 of a pixel's.
TEST(UnbouncePixels, ErrorsOfPixels) {
    const Scene scene;
    std::mt19937 engine(1);
    std::normal_distribution<double> normal;
    constexpr double error = 0.01;
    constexpr int repeats = 200;
    std::vector<double> sums(scene.factors.size()), squares = sums, variances = sums;
    for (int repeat = 0; repeat < repeats; ++repeat) {
        std::vector<Estimate> noisy;
        for (std::size_t j = 0; j < 8; ++j) {
            Estimate picture = scene.pictures().picture(j);
            picture.standard_error = Image(scene.width, scene.height);
            for (std::size_t p = 0; p < scene.factors.size(); ++p) {
                picture.mean.pixels[p].x += error * normal(engine);
                picture.standard_error.pixels[p] = Rgb(error, 0.0, 0.0);
            }
            noisy.push_back(picture);
        }
        LightPictures pictures = scene.pictures();
        pictures.picture = [&](std::size_t j) { return noisy[j]; };
        const Unbounced found = unbounce(pictures, scene.regions, nullptr, {.bounces = 2});
        for (std::size_t p = 0; p < sums.size(); ++p) {
            const double value = found.terms[1].mean.pixels[p].x, its = found.terms[1].standard_error.pixels[p].x;
            sums[p] += value;
            squares[p] += value * value;
            variances[p] += its * its / repeats;
        }
    }
    double ratio = 0.0;
    for (std::size_t p = 0; p < sums.size(); ++p)
        ratio += std::sqrt(variances[p] / ((squares[p] - sums[p] * sums[p] / repeats) / (repeats - 1))) /
                 static_cast<double>(sums.size());
    EXPECT_GT(ratio, 0.97);
    EXPECT_LT(ratio, 1.15);
}

std::string refused(const LightPictures& pictures, const Regions& regions) {
    try {
        unbounce(pictures, regions, nullptr, {});
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(UnbouncePixels, BadPicturesAreNamed) {
    const Scene scene;
    LightPictures pictures = scene.pictures();
    const auto good = pictures.picture;
    pictures.names = {"a.exr"};
    EXPECT_EQ(refused(pictures, scene.regions), "a.exr is the only picture; expected one for each of at least two lights");
    pictures.names = {"a.exr", "b.exr"};
    pictures.picture = [](std::size_t j) { return Estimate{Image(j == 0 ? 12 : 11, 8), {}}; };
    EXPECT_EQ(refused(pictures, scene.regions), "a pixel is in region 3, expected 1 to 2, as many as there are pictures");
    EXPECT_EQ(refused(pictures, block_regions(12, 8, 2, 1)), "b.exr: 11×8 pixels, expected 12×8 as in the first picture");
    pictures.picture = [](std::size_t) { return Estimate{Image(12, 8), {}}; };
    EXPECT_EQ(refused(pictures, block_regions(12, 8, 2, 1)),
              "all pictures are black where their lights shine; expected pictures of a scene under separate lights");
    pictures.picture = [&](std::size_t j) {
        Estimate picture = good(j);
        if (j == 1) picture.mean.at(3, 5).y = std::nan("");
        return picture;
    };
    EXPECT_EQ(refused(pictures, block_regions(12, 8, 2, 1)),
              "b.exr: pixel (3, 5) is not finite; expected a picture without such pixels");
    pictures.picture = [&](std::size_t) { return good(0); };
    try {
        unbounce(pictures, block_regions(12, 8, 2, 1), nullptr, {.regularisation = 0.0});
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "the matrix of pictures is singular; expected a regularisation above 0");
    }
}

}  // namespace neumann::unbounce_pixels_test
