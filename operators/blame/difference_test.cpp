#include "operators/blame/difference_test.h"

#include "operators/statistics/student_t.h"

#include <boost/math/special_functions/gamma.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace neumann {

namespace {

constexpr int block = 8;
constexpr double rounding = 2e-4;
constexpr double median_of_square = 0.4549;  // of a normal variable with variance 1

double mean_of(const Image& image, int c) {
    double sum = 0.0;
    for (const Rgb& v : image.pixels) sum += v[c];
    return sum / static_cast<double>(image.pixels.size());
}

// By how much the variance of a block's mean exceeds that of independent pixels: 1 + 2ρ in both directions, ρ the correlation of
// neighbours.
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

// The difference's mean in a channel of a block, and the variance of that mean. `said`: the sum of the pixels' variances.
void put_channel(BlockDifference& of, int c, const Image& difference, double said, double correlated, double least) {
    double sum = 0.0, squares = 0.0;
    for (int y = of.y; y < of.y + of.height; ++y)
        for (int x = of.x; x < of.x + of.width; ++x) {
            const double d = difference.at(x, y)[c];
            sum += d;
            squares += d * d;
        }
    const double n = of.pixels(), mean = sum / n, spread = n > 1.0 ? std::max(squares - n * mean * mean, 0.0) / (n - 1.0) : 0.0;
    of.mean[c] = mean;
    of.variance[c] = std::max(spread, said / n) * correlated / n + least * least;
}

// The smallest of three: the mean over all blocks, the block that differs most, and the sum of squares.
double p_of(const std::vector<BlockDifference>& blocks, int c) {
    double sum = 0.0, variance = 0.0, squares = 0.0, most = 1.0;
    for (const BlockDifference& b : blocks) {
        sum += b.mean[c];
        variance += b.variance[c];
        const double t2 = b.mean[c] * b.mean[c] / b.variance[c], freedom = std::max(b.pixels() - 1.0, 1.0);
        squares += t2 * (freedom > 3.0 ? (freedom - 2.0) / freedom : 0.3);  // Student's t has a larger variance than 1
        most = std::min(most, student_t_two_sided(std::sqrt(t2), freedom));
    }
    const auto n = static_cast<double>(blocks.size());
    const double of_mean = student_t_two_sided(std::abs(sum) / std::sqrt(variance), 30.0),
                 of_squares = boost::math::gamma_q(0.5 * n, 0.5 * squares);
    return std::min(3.0 * std::min({of_mean, most * n, of_squares}), 1.0);
}

}  // namespace

Image local_variance(const Image& picture) {
    Image squares(picture.width, picture.height), result(picture.width, picture.height);
    const auto at = [&](int x, int y) -> const Rgb& {
        return picture.at(std::clamp(x, 0, picture.width - 1), std::clamp(y, 0, picture.height - 1));
    };
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const Rgb d = at(x, y) - (at(x - 1, y) + at(x + 1, y) + at(x, y - 1) + at(x, y + 1)) * 0.25;
            squares.at(x, y) = d * d / 1.25;
        }
    constexpr int reach = 3;
    std::vector<double> around;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            for (int c = 0; c < 3; ++c) {
                around.clear();
                for (int j = std::max(y - reach, 0); j <= std::min(y + reach, picture.height - 1); ++j)
                    for (int i = std::max(x - reach, 0); i <= std::min(x + reach, picture.width - 1); ++i)
                        around.push_back(squares.at(i, j)[c]);
                const auto middle = around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2);
                std::nth_element(around.begin(), middle, around.end());
                result.at(x, y)[c] = *middle / median_of_square;
            }
    return result;
}

double times_the_variance(const Image& picture, const PictureNoise& known) {
    constexpr double enough = 0.02;  // part of the pixels
    const Image around = local_variance(picture);
    std::vector<double> by_difference, by_neighbours;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            if (const double v = known.variance.pixels[i][c]; v > 0.0) {
                const double d = picture.pixels[i][c] - known.mean.pixels[i][c];
                by_difference.push_back(d * d / v / median_of_square - 1.0);
                by_neighbours.push_back(around.pixels[i][c] / v);
            }
    if (static_cast<double>(by_difference.size()) < enough * 3.0 * static_cast<double>(picture.pixels.size()))
        return std::numeric_limits<double>::infinity();
    const auto median = [](std::vector<double>& values) {
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        return *middle;
    };
    return std::max(std::min(median(by_difference), median(by_neighbours)), 0.0);
}

Estimate difference_of(const PictureNoise& a, const PictureNoise& b) {
    Estimate difference{a.mean, a.variance};
    Rgb least(0.0);
    for (int c = 0; c < 3; ++c) least[c] = rounding * std::max(std::abs(mean_of(a.mean, c)), std::abs(mean_of(b.mean, c)));
    for (std::size_t i = 0; i < difference.mean.pixels.size(); ++i) {
        difference.mean.pixels[i] -= b.mean.pixels[i];
        difference.standard_error.pixels[i] = glm::sqrt(a.variance.pixels[i] + b.variance.pixels[i] + least * least);
    }
    return difference;
}

std::vector<BlockDifference> block_differences(const PictureNoise& a, const PictureNoise& b) {
    Image difference = a.mean;
    for (std::size_t i = 0; i < difference.pixels.size(); ++i) difference.pixels[i] -= b.mean.pixels[i];
    std::vector<BlockDifference> blocks;
    for (int y = 0; y < difference.height; y += block)
        for (int x = 0; x < difference.width; x += block)
            blocks.push_back(
                {x, y, std::min(block, difference.width - x), std::min(block, difference.height - y), Rgb(0.0), Rgb(0.0)});
    for (int c = 0; c < 3; ++c) {
        const double correlated = correlation_factor(difference, c);
        const double least = rounding * std::max(std::abs(mean_of(a.mean, c)), std::abs(mean_of(b.mean, c)));
        for (BlockDifference& of : blocks) {
            double said = 0.0;
            for (int y = of.y; y < of.y + of.height; ++y)
                for (int x = of.x; x < of.x + of.width; ++x) said += a.variance.at(x, y)[c] + b.variance.at(x, y)[c];
            put_channel(of, c, difference, said, correlated, least);
        }
    }
    return blocks;
}

DifferenceTest test_difference(const PictureNoise& a, const PictureNoise& b) {
    const std::vector<BlockDifference> blocks = block_differences(a, b);
    DifferenceTest result;
    double sum_a = 0.0, sum_b = 0.0, variance = 0.0;
    for (int c = 0; c < 3; ++c) {
        result.p = std::min(result.p, 3.0 * p_of(blocks, c));
        for (const BlockDifference& d : blocks) variance += d.variance[c] * d.pixels() * d.pixels();
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

namespace {

// −2 log of the likelihood of one pixel after the other.
class Misfits {
public:
    Misfits(const PictureNoise& a, const PictureNoise& b, const Image& usual) : a_(a), b_(b), usual_(usual) {
        for (int c = 0; c < 3; ++c)
            least_[c] = rounding * std::max({std::abs(mean_of(a.mean, c)), std::abs(mean_of(b.mean, c)), 1e-30});
    }
    double at(std::size_t i) const {
        constexpr double freedom = 4.0;
        double sum = 0.0;
        for (int c = 0; c < 3; ++c) {
            const double d = a_.mean.pixels[i][c] - b_.mean.pixels[i][c], known = a_.variance.pixels[i][c] + least_[c] * least_[c],
                         v = known + b_.variance.pixels[i][c];
            sum += (freedom + 1.0) * std::log1p(d * d / (freedom * v)) + std::log(known + usual_.pixels[i][c]);
        }
        return sum;
    }

private:
    const PictureNoise &a_, &b_;
    const Image& usual_;
    Rgb least_{0.0};
};

}  // namespace

double misfit(const PictureNoise& a, const PictureNoise& b, const Image& usual) {
    const Misfits misfits(a, b, usual);
    double sum = 0.0;
    for (std::size_t i = 0; i < a.mean.pixels.size(); ++i) sum += misfits.at(i);
    return sum;
}

double evidence_for(const PictureNoise& a, const PictureNoise& b, const PictureNoise& other) {
    constexpr double most = 3.0;
    Rgb least(0.0);
    for (int c = 0; c < 3; ++c) least[c] = std::max(rounding * std::abs(mean_of(a.mean, c)), 1e-30);
    double sum = 0.0;
    for (std::size_t i = 0; i < a.mean.pixels.size(); ++i) {
        double pixel = 0.0;
        for (int c = 0; c < 3; ++c) {
            const double v_b = b.variance.pixels[i][c], v_other = other.variance.pixels[i][c],
                         d_b = a.mean.pixels[i][c] - b.mean.pixels[i][c], d_other = a.mean.pixels[i][c] - other.mean.pixels[i][c],
                         v = a.variance.pixels[i][c] + v_b + v_other + least[c] * least[c];
            pixel += ((d_other * d_other - v_other) - (d_b * d_b - v_b)) / v;  // without what noise adds
        }
        sum += std::clamp(pixel, -most, most);
    }
    return sum;
}

}  // namespace neumann
