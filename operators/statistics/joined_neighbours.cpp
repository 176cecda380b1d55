#include "operators/statistics/joined_neighbours.h"

#include "core/base/hot.h"
#include "operators/statistics/student_t.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <cmath>
#include <vector>

namespace neumann {

namespace {

constexpr int radius = 3;  // of the neighbours

// One channel, row by row, as parts of its largest value: the means, their variances, and the mean variance of the neighbours.
struct Channel {
    std::size_t width, height;
    double largest = 0.0;
    std::vector<float> mean, variance, typical;

    Channel(const Estimate& picture, int c)
        : width(static_cast<std::size_t>(picture.mean.width)), height(static_cast<std::size_t>(picture.mean.height)) {
        for (const Rgb& pixel : picture.mean.pixels) largest = std::max(largest, std::abs(pixel[c]));
        const double scale = largest > 0.0 ? 1.0 / largest : 0.0;
        for (std::size_t p = 0; p < width * height; ++p) {
            const double error = scale * picture.standard_error.pixels[p][c];
            mean.push_back(static_cast<float>(scale * picture.mean.pixels[p][c]));
            variance.push_back(static_cast<float>(error * error));
        }
        const std::vector<float> of_rows = mean_of_near(variance, height, width, 1, width);
        typical = mean_of_near(of_rows, width, height, width, 1);
    }

private:
    // The means of values and of those near them, along lines of `length` values that are `step` apart.
    static std::vector<float> mean_of_near(const std::vector<float>& of, std::size_t lines, std::size_t length, std::size_t step,
                                           std::size_t next_line) {
        constexpr std::size_t r = radius;
        std::vector<float> means(of.size());
        for (std::size_t line = 0; line < lines; ++line)
            for (std::size_t i = 0; i < length; ++i) {
                const std::size_t begin = i - std::min(i, r), end = std::min(i + r + 1, length);
                float sum = 0.0f;
                for (std::size_t j = begin; j < end; ++j) sum += of[line * next_line + j * step];
                means[line * next_line + i * step] = sum / static_cast<float>(end - begin);
            }
        return means;
    }
};

// t of a two-sided test at 5%, for the difference of two means with ν degrees of freedom each: of ν, if only one of them has an
// error, to 2 ν, if both have the same (Welch and Satterthwaite); in between it is interpolated.
struct WelchTest {
    float t_of_one, more_of_two;

    explicit WelchTest(double degrees_of_freedom)
        : t_of_one(static_cast<float>(student_t_quantile(0.95, degrees_of_freedom))),
          more_of_two(static_cast<float>(student_t_quantile(0.95, 2.0 * degrees_of_freedom)) - t_of_one) {}
};

// Adds n neighbours, one for each of n pixels, with this weight.
NEUMANN_HOT void add_neighbours(const WelchTest& test, float weight, std::size_t n, const float* mean, const float* variance,
                                const float* typical, const float* near_mean, const float* near_variance, float* __restrict sum,
                                float* __restrict weights) {
    constexpr float tiny = 1e-30f;  // keeps sums finite where nothing has an error
    for (std::size_t i = 0; i < n; ++i) {
        const float a = variance[i], b = near_variance[i], difference = near_mean[i] - mean[i], both = a + b,
                    two = both * both / (a * a + b * b + tiny) - 1.0f, t = test.t_of_one + two * test.more_of_two;
        // A pixel that met rare light is uncertain; one that met nothing is no more certain than the others.
        const float w = difference * difference <= t * t * both ? weight / (b + typical[i] + tiny) : 0.0f;
        sum[i] += w * near_mean[i];
        weights[i] += w;
    }
}

void join_row(const Channel& channel, const WelchTest& test, std::size_t y, std::vector<float>& sum, std::vector<float>& weights) {
    const std::size_t width = channel.width;
    sum.assign(width, 0.0f);
    weights.assign(width, 0.0f);
    for (int down = -radius; down <= radius; ++down)
        for (int across = -radius; across <= radius; ++across) {
            const auto row = static_cast<std::ptrdiff_t>(y) + down;
            if (row < 0 || row >= static_cast<std::ptrdiff_t>(channel.height)) continue;
            const auto left = static_cast<std::size_t>(std::max(-across, 0)), right = static_cast<std::size_t>(std::max(across, 0));
            if (left + right >= width) continue;
            const std::size_t here = y * width + left, near = static_cast<std::size_t>(row) * width + right;
            add_neighbours(test, std::exp(-2.0f * static_cast<float>(across * across + down * down) / (radius * radius)),
                           width - left - right, &channel.mean[here], &channel.variance[here], &channel.typical[here],
                           &channel.mean[near], &channel.variance[near], &sum[left], &weights[left]);
        }
}

}  // namespace

Image joined_neighbours(const Estimate& picture) {
    Image joined = picture.mean;
    if (!(picture.degrees_of_freedom >= 1.0)) return joined;
    const WelchTest test(picture.degrees_of_freedom);
    for (int c = 0; c < 3; ++c) {
        const Channel channel(picture, c);
        oneapi::tbb::parallel_for(std::size_t{0}, channel.height, [&](std::size_t y) {
            std::vector<float> sum, weights;
            join_row(channel, test, y, sum, weights);
            for (std::size_t x = 0; x < channel.width; ++x)
                joined.pixels[y * channel.width + x][c] = channel.largest * sum[x] / weights[x];
        });
    }
    return joined;
}

}  // namespace neumann
