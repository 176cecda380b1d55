#include "operators/experiments/blame/explained.h"

#include "operators/experiments/blame/difference_test.h"

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

constexpr double beyond_chance = 4.0;  // standard deviations of a sum of squares

// The standard deviation, with noise alone, of a sum of n squares in three channels that are fully correlated.
double by_chance(std::size_t n) { return std::sqrt(18.0 * static_cast<double>(n)); }

double part(double all, double left, double chance) { return all > beyond_chance * chance ? 1.0 - std::abs(left) / all : 0.0; }

}  // namespace

Explained::Explained(const PictureNoise& theirs, const PictureNoise& ours)
    : theirs_(theirs), ours_(ours), noise_(noise_of_neighbours(theirs, ours)) {}

double Explained::by(const PictureNoise& wrong) const { return std::max(by_blocks(wrong), by_pixels(wrong)); }

double Explained::by_blocks(const PictureNoise& wrong) const {
    const BlockDifferences without = block_differences(theirs_, ours_), with = block_differences(theirs_, wrong);
    double all = 0.0, left = 0.0;
    for (std::size_t i = 0; i < without.blocks.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const BlockDifference &x = without.blocks[i], &y = with.blocks[i];
            if (x.variance[c] <= 0.0) continue;
            all += (x.mean[c] * x.mean[c] - x.noise[c]) / x.variance[c];
            left += (y.mean[c] * y.mean[c] - y.noise[c]) / x.variance[c];
        }
    return part(all, left, by_chance(without.blocks.size()));
}

// The contribution of a pixel is limited, so that fireflies do not decide.
double Explained::beyond_noise(const PictureNoise& expected) const {
    constexpr double most = 50.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < noise_.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double variance = noise_.pixels[i][c] + ours_.variance.pixels[i][c];
            if (variance <= 0.0) continue;
            const double d = theirs_.mean.pixels[i][c] - expected.mean.pixels[i][c];
            sum += std::min((d * d - noise_.pixels[i][c] - expected.variance.pixels[i][c]) / variance, most);
        }
    return sum;
}

double Explained::by_pixels(const PictureNoise& wrong) const {
    return part(beyond_noise(ours_), beyond_noise(wrong), by_chance(noise_.pixels.size()));
}

}  // namespace neumann
