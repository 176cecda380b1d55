#include "operators/experiments/blame/difference_test.h"

#include "operators/statistics/student_t.h"

#include <boost/math/special_functions/gamma.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace neumann {

namespace {

constexpr int block = 8;
constexpr int reach = 1;  // the distance in blocks over which noise is pooled

// The factor by which the variance of a block's mean exceeds that of independent pixels: 1 + 2ρ in both directions,
// with ρ the correlation of neighbours.
double correlation_factor(const Image& difference, int c) {
    double all = 0.0, across = 0.0, down = 0.0, n_all = 0.0, n_across = 0.0, n_down = 0.0;
    for (int y0 = 0; y0 < difference.height; y0 += block)
        for (int x0 = 0; x0 < difference.width; x0 += block) {
            const int x1 = std::min(x0 + block, difference.width), y1 = std::min(y0 + block, difference.height);
            double mean = 0.0;
            for (int y = y0; y < y1; ++y)
                for (int x = x0; x < x1; ++x) mean += difference.at(x, y)[c];
            mean /= (x1 - x0) * (y1 - y0);
            for (int y = y0; y < y1; ++y)
                for (int x = x0; x < x1; ++x) {
                    const double d = difference.at(x, y)[c] - mean;
                    all += d * d;
                    ++n_all;
                    if (x + 1 < x1) {
                        across += d * (difference.at(x + 1, y)[c] - mean);
                        ++n_across;
                    }
                    if (y + 1 < y1) {
                        down += d * (difference.at(x, y + 1)[c] - mean);
                        ++n_down;
                    }
                }
        }
    if (all <= 0.0 || n_across == 0.0 || n_down == 0.0) return 1.0;
    const auto factor = [&](double products, double n) { return 1.0 + 2.0 * std::clamp(products / n / (all / n_all), 0.0, 1.0); };
    return factor(across, n_across) * factor(down, n_down);
}

// The noise of one channel of a block alone, without its neighbours.
struct BlockNoise {
    double variance = 0.0;                             // of a pixel
    double level = 0.0;                                // mean of the brighter of both pictures
    double squares = 0.0, cubes = 0.0, fourths = 0.0;  // sums over pixels of the difference less its mean, to these powers
};

// `variances`: the sum of the variances that the pictures have for the pixels.
BlockNoise noise_in(BlockDifference& block, int c, const Image& difference, double variances) {
    double sum = 0.0;
    const auto for_pixels = [&](const auto& f) {
        for (int y = block.y; y < block.y + block.height; ++y)
            for (int x = block.x; x < block.x + block.width; ++x) f(difference.at(x, y)[c]);
    };
    for_pixels([&](double d) { sum += d; });
    const double n = block.pixels(), mean = sum / n;
    block.mean[c] = mean;
    BlockNoise noise;
    for_pixels([&](double d) {
        const double square = (d - mean) * (d - mean);
        noise.squares += square;
        noise.cubes += square * (d - mean);
        noise.fourths += square * square;
    });
    noise.variance = std::max(n > 1.0 ? noise.squares / (n - 1.0) : 0.0, variances / n);
    return noise;
}

struct PooledNoise {
    double variance = 0.0, light = 0.0, squares = 0.0, cubes = 0.0, fourths = 0.0, pixels = 0.0;

    void add(const BlockNoise& block, double its_pixels) {
        variance += its_pixels * block.variance;
        light += its_pixels * block.level;
        squares += block.squares;
        cubes += block.cubes;
        fourths += block.fourths;
        pixels += its_pixels;
    }
    // The variance of a pixel in units of its light.
    double by_light() const { return light > 0.0 ? variance / light : 0.0; }
    // Degrees of freedom of Student's t for such a difference. If the difference has the sign of the long tail, the
    // noise is known as well as all pixels show it. Rare events that have not come make a picture darker and hide their
    // noise: with the other sign, knowledge rests on the events that have come. With k events of one size these are k
    // degrees, and with Gaussian noise a third of the pixels.
    double freedom(double difference) const {
        const bool is_by_events = difference * cubes > 0.0;
        const double events = fourths > 0.0 ? squares * squares / fourths : 0.0;
        return std::max((is_by_events ? pixels : events) - 1.0, 1.0);
    }
};

// The smallest of three probabilities: by the mean over all blocks, by the largest difference, by the sum of squares.
double p_of(const BlockDifferences& differences, int c) {
    double sum = 0.0, variance = 0.0, squares = 0.0, most = 1.0;
    for (const BlockDifference& b : differences.blocks) {
        sum += b.mean[c] * b.pixels();
        variance += b.noise[c] * b.pixels() * b.pixels();
        if (b.mean[c] == 0.0) continue;
        const double t2 = b.mean[c] * b.mean[c] / b.variance[c], freedom = b.freedom[c];
        squares += t2 * (freedom > 3.0 ? (freedom - 2.0) / freedom : 0.3);  // Student's t has a larger variance than 1
        most = std::min(most, student_t_two_sided(std::sqrt(t2), freedom));
    }
    const auto n = static_cast<double>(differences.blocks.size());
    const double of_mean = sum == 0.0 ? 1.0 : student_t_two_sided(std::abs(sum) / std::sqrt(variance), differences.freedom[c]),
                 of_squares = boost::math::gamma_q(0.5 * n, 0.5 * squares);
    return std::min(3.0 * std::min({of_mean, most * n, of_squares}), 1.0);
}

}  // namespace

BlockDifferences block_differences(const PictureNoise& a, const PictureNoise& b) {
    Image difference = a.mean;
    for (std::size_t i = 0; i < difference.pixels.size(); ++i) difference.pixels[i] -= b.mean.pixels[i];
    BlockDifferences result;
    std::vector<BlockDifference>& blocks = result.blocks;
    for (int y = 0; y < difference.height; y += block)
        for (int x = 0; x < difference.width; x += block)
            blocks.push_back({x, y, std::min(block, difference.width - x), std::min(block, difference.height - y)});
    const int across = (difference.width + block - 1) / block, down = (difference.height + block - 1) / block;
    for (int c = 0; c < 3; ++c) {
        const double correlated = correlation_factor(difference, c);
        const double least = rounding_of_pictures * std::max(std::abs(mean_of(a.mean, c)), std::abs(mean_of(b.mean, c)));
        std::vector<BlockNoise> noise;
        double sum = 0.0;
        PooledNoise everywhere;
        for (BlockDifference& block : blocks) {
            double variances = 0.0, light_a = 0.0, light_b = 0.0;
            for (int y = block.y; y < block.y + block.height; ++y)
                for (int x = block.x; x < block.x + block.width; ++x) {
                    variances += a.variance.at(x, y)[c] + b.variance.at(x, y)[c];
                    light_a += a.mean.at(x, y)[c];
                    light_b += b.mean.at(x, y)[c];
                }
            noise.push_back(noise_in(block, c, difference, variances));
            noise.back().level = std::max(std::abs(light_a), std::abs(light_b)) / block.pixels();
            everywhere.add(noise.back(), block.pixels());
            sum += block.mean[c] * block.pixels();
        }
        result.freedom[c] = everywhere.freedom(sum);
        for (int y = 0; y < down; ++y)
            for (int x = 0; x < across; ++x) {
                PooledNoise around;
                for (int j = std::max(y - reach, 0); j <= std::min(y + reach, down - 1); ++j)
                    for (int i = std::max(x - reach, 0); i <= std::min(x + reach, across - 1); ++i) {
                        const auto other = static_cast<std::size_t>(j * across + i);
                        around.add(noise[other], blocks[other].pixels());
                    }
                const auto i = static_cast<std::size_t>(y * across + x);
                const double pixels = blocks[i].pixels(), pooled = around.by_light() * noise[i].level;
                blocks[i].noise[c] = noise[i].variance * correlated / pixels + least * least;
                blocks[i].variance[c] = std::max(noise[i].variance, pooled) * correlated / pixels + least * least;
                blocks[i].freedom[c] = around.freedom(blocks[i].mean[c]);
            }
    }
    return result;
}

DifferenceTest test_difference(const PictureNoise& a, const PictureNoise& b) {
    const BlockDifferences differences = block_differences(a, b);
    DifferenceTest result;
    double sum_a = 0.0, sum_b = 0.0, variance = 0.0;
    for (int c = 0; c < 3; ++c) {
        result.p = std::min(result.p, 3.0 * p_of(differences, c));
        for (const BlockDifference& d : differences.blocks) variance += d.noise[c] * d.pixels() * d.pixels();
        for (const Rgb& v : a.mean.pixels) sum_a += v[c];
        for (const Rgb& v : b.mean.pixels) sum_b += v[c];
    }
    result.p = std::min(result.p, 1.0);
    if (sum_b != 0.0) {
        result.ratio = sum_a / sum_b;
        result.ratio_error = std::sqrt(3.0 * variance) / std::abs(sum_b);  // channels share their samples
    } else {
        result.ratio = sum_a == 0.0 ? 1.0 : std::numeric_limits<double>::infinity();
    }
    return result;
}

}  // namespace neumann
