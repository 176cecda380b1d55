// Previews: what agrees is joined, and what differs is not.
#include "operators/statistics/joined_neighbours.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace neumann {
namespace {

constexpr int size = 64;
constexpr double replicates = 8.0, noise = 0.1;

// The left half has one value and the right half another. Each pixel has means of replicates with normal noise.
Estimate noisy_edge(double left, double right) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal(0.0, noise);
    Estimate picture{Image(size, size), Image(size, size), replicates - 1.0};
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            for (int c = 0; c < 3; ++c) {
                double sum = 0.0, squares = 0.0;
                for (int r = 0; r < static_cast<int>(replicates); ++r) {
                    const double v = (x < size / 2 ? left : right) + normal(random);
                    sum += v;
                    squares += v * v;
                }
                const double mean = sum / replicates;
                picture.mean.pixels[static_cast<std::size_t>(y * size + x)][c] = mean;
                picture.standard_error.pixels[static_cast<std::size_t>(y * size + x)][c] =
                    std::sqrt(std::max(squares / replicates - mean * mean, 0.0) / (replicates - 1.0));
            }
    return picture;
}

double rms(const Image& image, double left, double right) {
    double sum = 0.0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            for (int c = 0; c < 3; ++c)
                sum += std::pow(image.pixels[static_cast<std::size_t>(y * size + x)][c] - (x < size / 2 ? left : right), 2);
    return std::sqrt(sum / (3.0 * size * size));
}

// With equal weights a mean of 49 pixels would have a seventh of the noise; a Gaussian one of these has that of 16, and one test in
// twenty wrongly leaves a pixel out.
TEST(JoinedNeighbours, HaveLessNoise) {
    const Estimate picture = noisy_edge(1.0, 1.0);
    EXPECT_LT(rms(joined_neighbours(picture), 1.0, 1.0), rms(picture.mean, 1.0, 1.0) / 2.5);
}

// An edge of 20 standard errors is not crossed: with t = 2.4 to 2.1, none of 2·10⁵ pairs would agree by chance.
TEST(JoinedNeighbours, AreNotJoinedAcrossAnEdge) {
    const double right = 1.0 + 20.0 * noise / std::sqrt(replicates);
    const Estimate picture = noisy_edge(1.0, right);
    EXPECT_LT(rms(joined_neighbours(picture), 1.0, right), rms(picture.mean, 1.0, right) / 2.0);
}

// A pixel that one bright path met is uncertain, and its neighbours, which did not meet it, tell what it is.
TEST(JoinedNeighbours, OfABrightPixelTellWhatItIs) {
    Estimate picture = noisy_edge(1.0, 1.0);
    const std::size_t bright = size * size / 2 + size / 4;
    picture.mean.pixels[bright] = Rgb(101.0);
    picture.standard_error.pixels[bright] = Rgb(100.0);
    EXPECT_NEAR(joined_neighbours(picture).pixels[bright].r, 1.0, 0.5);
}

// A lamp whose pixels all are alike, beside darkness.
TEST(JoinedNeighbours, OfPixelsWithoutErrorsAreTheirEquals) {
    Estimate picture = noisy_edge(0.0, 0.0);
    for (Rgb& error : picture.standard_error.pixels) error = Rgb(0.0);
    for (std::size_t p = 0; p < picture.mean.pixels.size(); ++p)
        picture.mean.pixels[p] = p % size < size / 3 ? Rgb(0.75) : Rgb(0.0);
    const Image joined = joined_neighbours(picture);
    for (std::size_t p = 0; p < joined.pixels.size(); ++p) EXPECT_NEAR(joined.pixels[p].r, picture.mean.pixels[p].r, 1e-6) << p;
}

TEST(JoinedNeighbours, NoneWithoutDegreesOfFreedom) {
    Estimate picture = noisy_edge(1.0, 2.0);
    picture.degrees_of_freedom = 0.0;
    const Image joined = joined_neighbours(picture);
    EXPECT_EQ(joined.pixels, picture.mean.pixels);
}

}  // namespace
}  // namespace neumann
