#include "operators/experiments/study/picture_errors.h"

#include "core/base/error.h"
#include "operators/experiments/study/u_statistic.h"
#include "operators/statistics/metrics.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace neumann {

namespace {

double mean_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

WithError mean_with_error(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    const double mean = mean_of(values);
    double squares = 0.0;
    for (const double x : values) squares += (x - mean) * (x - mean);
    return {mean, std::sqrt(squares / (n * (n - 1.0)))};
}

SymmetricMatrix gram_matrix(const std::vector<std::vector<float>>& errors) {
    SymmetricMatrix g(errors.size());
    oneapi::tbb::parallel_for(std::size_t{0}, errors.size(), [&](std::size_t j) {
        for (std::size_t k = 0; k <= j; ++k) {
            double sum = 0.0;
            for (std::size_t i = 0; i < errors[j].size(); ++i) sum += static_cast<double>(errors[j][i]) * errors[k][i];
            g.set(j, k, sum / static_cast<double>(errors[j].size()));
        }
    });
    return g;
}

// V = (Σ G_jj − Σ G_jk / R) / (R − 1) with its jackknife error (Efron and Stein, 1981).
WithError variance_of(const SymmetricMatrix& g) {
    const std::size_t repeats = g.size();
    const auto n = static_cast<double>(repeats);
    double trace = 0.0, all = 0.0;
    std::vector<double> row(repeats);
    for (std::size_t j = 0; j < repeats; ++j) {
        trace += g(j, j);
        for (std::size_t k = 0; k < repeats; ++k) row[j] += g(j, k);
        all += row[j];
    }
    const double variance = std::max((trace - all / n) / (n - 1.0), 0.0);
    if (repeats < 3) return {variance, std::numeric_limits<double>::infinity()};
    std::vector<double> without(repeats);
    for (std::size_t j = 0; j < repeats; ++j)
        without[j] = (trace - g(j, j) - (all - 2.0 * row[j] + g(j, j)) / (n - 1.0)) / (n - 2.0);
    return {variance, (n - 1.0) * mean_with_error(without).standard_error};
}

}  // namespace

PictureErrors::PictureErrors(Estimate reference) : reference_(std::move(reference)) {
    Image& error = reference_.standard_error;
    if (error.pixels.empty()) error = Image(reference_.mean.width, reference_.mean.height);
    Image noisy = reference_.mean;
    for (std::size_t i = 0; i < noisy.pixels.size(); ++i) {
        if (!is_finite(reference_.mean.pixels[i])) throw InputError("the reference has pixels that are not finite");
        if (!is_finite(error.pixels[i]))
            throw InputError("the reference does not know its error: it is of a single replicate; take one of more samples");
        noisy.pixels[i] += error.pixels[i];
    }
    const Metrics noise = compare(noisy, reference_.mean);
    reference_mse_ = noise.rmse * noise.rmse;
    reference_rel_mse_ = noise.rel_mse;
}

void PictureErrors::add(const Image& picture) {
    rel_mse_.push_back(compare(picture, reference_.mean).rel_mse - reference_rel_mse_);
    std::vector<float>& errors = errors_.emplace_back();
    errors.reserve(3 * picture.pixels.size());
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) errors.push_back(static_cast<float>(picture.pixels[i][c] - reference_.mean.pixels[i][c]));
}

double PictureErrors::reference_size() const {
    return compare(reference_.mean, Image(reference_.mean.width, reference_.mean.height)).rmse;
}

// The standard error of ⟨η²⟩ − ⟨v⟩ − 2⟨b, η⟩ with b = E x − r. For normal η, and v estimated with n degrees of freedom, a channel
// of a pixel has the variance 2v² (1 + 1/n) + 4b²v. Channels of a pixel share their samples, and pixels may; they are then treated
// as fully correlated.
double PictureErrors::reference_error() const {
    const double n = reference_.degrees_of_freedom;
    const double estimated = n > 0.0 ? 2.0 * (1.0 + 1.0 / n) : 2.0;
    const auto repeats = static_cast<double>(errors_.size());
    double together = 0.0, apart = 0.0;
    for (std::size_t pixel = 0; pixel < reference_.mean.pixels.size(); ++pixel) {
        double channels = 0.0;
        for (int c = 0; c < 3; ++c) {
            const double error = reference_.standard_error.pixels[pixel][c], v = error * error;
            double sum = 0.0, squares = 0.0;
            for (const auto& e : errors_) {
                const double x = e[3 * pixel + static_cast<std::size_t>(c)];
                sum += x;
                squares += x * x;
            }
            const double mean = sum / repeats, spread = std::max(squares - sum * mean, 0.0) / (repeats * (repeats - 1.0));
            const double bias_squared = std::max(mean * mean - spread - v, 0.0);
            channels += std::sqrt(estimated * v * v + 4.0 * bias_squared * v);
        }
        together += channels;
        apart += channels * channels;
    }
    return (reference_.pixels_are_independent ? std::sqrt(apart) : together) /
           (3.0 * static_cast<double>(reference_.mean.pixels.size()));
}

ErrorStatistics PictureErrors::statistics() const {
    const SymmetricMatrix g = gram_matrix(errors_);
    ErrorStatistics result;
    result.rel_mse = rel_mse_;
    for (std::size_t j = 0; j < g.size(); ++j) result.mse.push_back(g(j, j) - reference_mse_);
    result.mean_mse = mean_with_error(result.mse);
    result.mean_rel_mse = mean_with_error(result.rel_mse);
    result.variance = variance_of(g);
    result.bias_squared = {u_statistic(g) - reference_mse_, u_statistic_error(g)};
    result.reference_error = reference_error();
    return result;
}

}  // namespace neumann
