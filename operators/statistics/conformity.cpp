#include "operators/statistics/conformity.h"

#include "core/base/error.h"
#include "operators/statistics/student_t.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

namespace neumann {

namespace {

constexpr double false_alarms = 0.01;
constexpr double infinity = std::numeric_limits<double>::infinity();

void check_size(const Image& a, const Image& b) {
    if (a.width != b.width || a.height != b.height)
        throw InputError(fmt::format("{}×{} pixels against {}×{}", a.width, a.height, b.width, b.height));
}

// z(pixel, channel) has Student's distribution if picture and reference agree.
template <class Statistic>
Conformity judge(const Image& picture, double degrees_of_freedom, const Statistic& z) {
    Conformity result{0.0, Image(picture.width, picture.height)};
    const auto pixels = static_cast<double>(picture.pixels.size());
    const double level = -std::expm1(std::log1p(-false_alarms) / pixels);
    std::size_t accepted = 0;
    for (std::size_t pixel = 0; pixel < picture.pixels.size(); ++pixel)
        for (int c = 0; c < 3; ++c) {
            const double p = student_t_two_sided(z(pixel, c), degrees_of_freedom);
            result.p_values.pixels[pixel][c] = p;
            accepted += p > level;
        }
    result.accepted = static_cast<double>(accepted) / (3.0 * pixels);
    return result;
}

}  // namespace

Conformity conformity_by_reference(const Image& picture, std::uint64_t samples, const SampledReference& reference) {
    check_size(picture, reference.mean);
    check_size(picture, reference.variance);
    constexpr double least_variance = 1e-4;
    return judge(picture, infinity, [&](std::size_t pixel, int c) {
        const double variance = std::max(reference.variance.pixels[pixel][c], least_variance);
        return (picture.pixels[pixel][c] - reference.mean.pixels[pixel][c]) * std::sqrt(static_cast<double>(samples) / variance);
    });
}

Conformity conformity_by_error(const Estimate& picture, const SampledReference& reference) {
    check_size(picture.mean, reference.mean);
    check_size(picture.mean, reference.variance);
    const auto n = static_cast<double>(reference.samples), samples = picture.degrees_of_freedom + 1.0;
    // The rounding to half floats at the end and to floats in each addition: uniformly distributed errors have the
    // standard deviation bound / √3.
    const double rounding = std::hypot(0x1p-11, n * 0x1p-25) / std::sqrt(3.0);
    return judge(picture.mean, picture.degrees_of_freedom, [&](std::size_t pixel, int c) {
        const double mean = reference.mean.pixels[pixel][c], difference = picture.mean.pixels[pixel][c] - mean;
        if (difference == 0.0) return 0.0;
        // The variance is a difference of two half floats, whose smallest positive value is 2⁻²⁴.
        const double stored = std::max(reference.variance.pixels[pixel][c], 0.0);
        const double of_sample = stored + 0x1p-11 * (mean * mean + stored) + 0x1p-24;
        // If the picture's samples missed rare events, their spread is too small.
        const double own = std::max(std::pow(picture.standard_error.pixels[pixel][c], 2), of_sample / samples);
        return difference / std::sqrt(own + of_sample / n + std::pow(rounding * mean, 2));
    });
}

double brightness(const Image& picture, const Image& reference) {
    const auto mean_y = [](const Image& xyz) {
        double sum = 0.0;
        for (const Rgb& pixel : xyz.pixels) sum += pixel.g;
        return sum / static_cast<double>(xyz.pixels.size());
    };
    return mean_y(picture) / mean_y(reference);
}

}  // namespace neumann
