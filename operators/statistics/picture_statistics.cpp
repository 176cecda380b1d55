#include "operators/statistics/picture_statistics.h"

#include "core/base/error.h"
#include "operators/statistics/student_t.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

// √(a / b), with 0/0 = 0. Callers divide the numbers by the largest one before they add up squares, so that these
// neither overflow nor underflow.
double root_of_ratio(double a, double b) { return a == 0.0 ? 0.0 : std::sqrt(a / b); }

double largest(const Image& image) {
    double value = 0.0;
    for (const Rgb& p : image.pixels) value = std::max({value, std::abs(p.r), std::abs(p.g), std::abs(p.b)});
    return value;
}

// `value` is applied to a pixel and to its standard error.
template <class Value>
MeanWithError mean_of(const Estimate& estimate, const Value& value) {
    const std::size_t n = estimate.mean.pixels.size();
    if (n == 0) return {};
    double sum = 0.0, largest_error = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        sum += value(estimate.mean.pixels[i]);
        largest_error = std::max(largest_error, value(estimate.standard_error.pixels[i]));
    }
    const double mean = sum / static_cast<double>(n), df = estimate.degrees_of_freedom;
    if (largest_error == 0.0 || !std::isfinite(largest_error)) return {mean, largest_error, df};
    double variance = 0.0, variance2 = 0.0, sum_of_errors = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const double error = value(estimate.standard_error.pixels[i]) / largest_error, v = error * error;
        variance += v;
        variance2 += v * v;
        sum_of_errors += error;
    }
    if (!estimate.pixels_are_independent) return {mean, largest_error * sum_of_errors / static_cast<double>(n), df};
    return {mean, largest_error * std::sqrt(variance) / static_cast<double>(n), df * variance * variance / variance2};
}

// √(Σ error² / Σ mean²)
double relative_size(const Image& errors_of, const Image& picture) {
    const double scale = largest(picture);
    if (scale == 0.0) return 0.0;
    double errors = 0.0, means = 0.0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const Rgb mean = picture.pixels[i] / scale, error = errors_of.pixels[i] / scale;
        errors += glm::dot(error, error);
        means += glm::dot(mean, mean);
    }
    return root_of_ratio(errors, means);
}

}  // namespace

double MeanWithError::interval() const {
    return standard_error == 0.0 ? 0.0 : student_t_quantile(0.95, degrees_of_freedom) * standard_error;
}

MeanWithError picture_mean(const Estimate& estimate) { return mean_of(estimate, mean_component); }

PictureMeans picture_means(const Estimate& estimate) {
    PictureMeans means;
    for (int c = 0; c < 3; ++c) means.channel[c] = mean_of(estimate, [c](const Rgb& v) { return v[c]; });
    means.all = picture_mean(estimate);
    return means;
}

MeanWithError difference(const MeanWithError& a, const MeanWithError& b) {
    const double error = std::hypot(a.standard_error, b.standard_error);
    if (error == 0.0) return {a.mean - b.mean, 0.0, std::min(a.degrees_of_freedom, b.degrees_of_freedom)};
    const double share_a = std::pow(a.standard_error / error, 4), share_b = std::pow(b.standard_error / error, 4);
    return {a.mean - b.mean, error, 1.0 / (share_a / a.degrees_of_freedom + share_b / b.degrees_of_freedom)};
}

double relative_standard_error(const Estimate& estimate) { return relative_size(estimate.standard_error, estimate.mean); }

double relative_discretisation(const Estimate& estimate) {
    return estimate.discretisation.pixels.empty() ? 0.0 : relative_size(estimate.discretisation, estimate.mean);
}

double relative_error(const Image& test, const Image& reference) {
    if (test.width != reference.width || test.height != reference.height)
        throw InputError(fmt::format("the pictures differ in size: {}×{} and {}×{}", test.width, test.height, reference.width,
                                     reference.height));
    const double scale = std::max(largest(test), largest(reference));
    if (scale == 0.0) return 0.0;
    double errors = 0.0, references = 0.0;
    for (std::size_t i = 0; i < test.pixels.size(); ++i) {
        const Rgb error = (test.pixels[i] - reference.pixels[i]) / scale, r = reference.pixels[i] / scale;
        errors += glm::dot(error, error);
        references += glm::dot(r, r);
    }
    return root_of_ratio(errors, references);
}

bool is_zero(const Image& image) {
    return std::all_of(image.pixels.begin(), image.pixels.end(), [](const Rgb& p) { return is_black(p); });
}

}  // namespace neumann
