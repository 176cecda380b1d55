#include "operators/experiments/blame/joined_pixels.h"

#include <algorithm>

namespace neumann {

namespace {

constexpr int most_pixels = 128 * 128;

int joined_size(int pixels, int factor) { return (pixels + factor - 1) / factor; }

// `power`: 1 for means, 2 for variances, which are those of means over as many pixels.
Image means_of_blocks(const Image& image, int factor, int power) {
    if (factor == 1 || image.pixels.empty()) return image;
    Image result(joined_size(image.width, factor), joined_size(image.height, factor));
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) {
            const int right = std::min((x + 1) * factor, image.width), low = std::min((y + 1) * factor, image.height);
            Rgb sum(0.0);
            for (int v = y * factor; v < low; ++v)
                for (int u = x * factor; u < right; ++u) sum += image.at(u, v);
            const double n = static_cast<double>(right - x * factor) * (low - y * factor);
            result.at(x, y) = sum / (power == 1 ? n : n * n);
        }
    return result;
}

}  // namespace

PictureNoise joined(const PictureNoise& picture, int factor) {
    return {means_of_blocks(picture.mean, factor, 1), means_of_blocks(picture.variance, factor, 2)};
}

ComparedTerm joined(const ComparedTerm& term, int factor) {
    ComparedTerm result{term.bounces,
                        joined(term.theirs, factor),
                        joined(term.ours, factor),
                        {},
                        means_of_blocks(term.left_open, factor, 2),
                        means_of_blocks(term.our_sum_before, factor, 1),
                        means_of_blocks(term.our_sum, factor, 1)};
    if (term.half_difference) result.half_difference = means_of_blocks(*term.half_difference, factor, 1);
    return result;
}

std::vector<std::uint32_t> at_middles(const std::vector<std::uint32_t>& values, int width, int factor) {
    const int height = static_cast<int>(values.size()) / width;
    std::vector<std::uint32_t> result;
    for (int y = 0; y < joined_size(height, factor); ++y)
        for (int x = 0; x < joined_size(width, factor); ++x) {
            const int u = std::min(x * factor + factor / 2, width - 1), v = std::min(y * factor + factor / 2, height - 1);
            result.push_back(values[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u)]);
        }
    return result;
}

int joining_factor(int width, int height) {
    int factor = 1;
    while (joined_size(width, factor) * joined_size(height, factor) > most_pixels) ++factor;
    return factor;
}

}  // namespace neumann
