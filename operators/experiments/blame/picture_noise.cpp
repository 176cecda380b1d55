#include "operators/experiments/blame/picture_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace neumann {

namespace {

constexpr double median_of_square = 0.4549;  // of a normal variable with variance 1

// The median of each pixel and of those up to three pixels away from it.
Image median_around(const Image& image) {
    constexpr int reach = 3;
    Image result(image.width, image.height);
    std::vector<double> around;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) {
                around.clear();
                for (int j = std::max(y - reach, 0); j <= std::min(y + reach, image.height - 1); ++j)
                    for (int i = std::max(x - reach, 0); i <= std::min(x + reach, image.width - 1); ++i)
                        around.push_back(image.at(i, j)[c]);
                const auto middle = around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2);
                std::nth_element(around.begin(), middle, around.end());
                result.at(x, y)[c] = *middle;
            }
    return result;
}

}  // namespace

double mean_of(const Image& image, int channel) {
    double sum = 0.0;
    for (const Rgb& v : image.pixels) sum += v[channel];
    return sum / static_cast<double>(image.pixels.size());
}

Image local_variance(const Image& picture) {
    Image squares(picture.width, picture.height);
    const auto at = [&](int x, int y) -> const Rgb& {
        return picture.at(std::clamp(x, 0, picture.width - 1), std::clamp(y, 0, picture.height - 1));
    };
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const Rgb d = at(x, y) - (at(x - 1, y) + at(x + 1, y) + at(x, y - 1) + at(x, y + 1)) * 0.25;
            squares.at(x, y) = d * d / 1.25;
        }
    Image result = median_around(squares);
    for (Rgb& c : result.pixels) c /= median_of_square;
    return result;
}

Image noise_of_neighbours(const PictureNoise& theirs, const PictureNoise& ours) {
    Image noise = local_variance(theirs.mean), difference = theirs.mean;
    for (std::size_t i = 0; i < difference.pixels.size(); ++i) difference.pixels[i] -= ours.mean.pixels[i];
    const Image of_difference = local_variance(difference);
    for (std::size_t i = 0; i < noise.pixels.size(); ++i) noise.pixels[i] = glm::min(noise.pixels[i], of_difference.pixels[i]);
    return noise;
}

double times_the_variance(const Image& picture, const PictureNoise& known) {
    constexpr double enough = 0.02;  // part of the pixels
    const Image around = local_variance(picture), known_around = median_around(known.variance);
    std::vector<double> by_difference, by_neighbours;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            if (const double v = known.variance.pixels[i][c]; v > 0.0) {
                const double d = picture.pixels[i][c] - known.mean.pixels[i][c];
                by_difference.push_back(d * d / v / median_of_square - 1.0);
                // Along the edge of a lamp the neighbours of a noisy pixel have no noise, and tell nothing.
                if (known_around.pixels[i][c] > 0.0) by_neighbours.push_back(around.pixels[i][c] / v);
            }
    const double least = enough * 3.0 * static_cast<double>(picture.pixels.size());
    const auto median = [&](std::vector<double>& values) {
        if (static_cast<double>(values.size()) < least) return std::numeric_limits<double>::infinity();
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        return *middle;
    };
    return std::max(std::min(median(by_difference), median(by_neighbours)), 0.0);
}

Estimate difference_of(const PictureNoise& a, const PictureNoise& b) {
    Estimate difference{a.mean, a.variance};
    Rgb least(0.0);
    for (int c = 0; c < 3; ++c)
        least[c] = rounding_of_pictures * std::max(std::abs(mean_of(a.mean, c)), std::abs(mean_of(b.mean, c)));
    for (std::size_t i = 0; i < difference.mean.pixels.size(); ++i) {
        difference.mean.pixels[i] -= b.mean.pixels[i];
        difference.standard_error.pixels[i] = glm::sqrt(a.variance.pixels[i] + b.variance.pixels[i] + least * least);
    }
    return difference;
}

}  // namespace neumann
