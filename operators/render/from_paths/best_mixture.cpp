#include "operators/render/from_paths/best_mixture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace neumann {

namespace {

constexpr int steps = 300;

// P_kb, bounce by bounce.
std::vector<double> precisions(const MixtureCosts& all, const std::vector<double>& numbers) {
    std::vector<double> P(all.errors * all.blocks, 0.0);
    for (std::size_t m = 0; m < all.methods; ++m)
        for (std::size_t k = 0; k < all.errors; ++k)
            for (std::size_t b = 0; b < all.blocks; ++b)
                P[k * all.blocks + b] += numbers[m * all.blocks + b] / all.variance(m, k, b);
    return P;
}

std::vector<double> errors_with(const MixtureCosts& all, const std::vector<double>& P) {
    std::vector<double> errors(all.errors, 0.0);
    for (std::size_t k = 0; k < all.errors; ++k)
        for (std::size_t b = 0; b < all.blocks; ++b) errors[k] += 1.0 / P[k * all.blocks + b];
    return errors;
}

void spend(const MixtureCosts& all, std::vector<double>& numbers) {
    double cost = 0.0;
    for (std::size_t i = 0; i < numbers.size(); ++i) cost += all.costs[i] * numbers[i];
    const double scale = all.budget / cost;
    for (double& s : numbers) s *= scale;
}

double error_of_sum(const MixtureCosts& all, const std::vector<double>& errors) {
    return std::inner_product(errors.begin(), errors.end(), all.sizes.begin(), 0.0);
}

double least_of(const MixtureCosts& all, const std::vector<double>& errors, double of_sum, LeastError least) {
    if (least.of == LeastError::Of::bounces) return *std::ranges::max_element(errors);
    if (least.of == LeastError::Of::sum) return of_sum;
    double logarithms = std::log(of_sum);
    for (const double e : errors) logarithms += std::log(e);
    return std::exp(logarithms / static_cast<double>(all.errors + 1));
}

}  // namespace

std::vector<double> best_mixture(const MixtureCosts& all, LeastError least) {
    std::vector<double> numbers(all.methods * all.blocks, 1.0), best;
    spend(all, numbers);
    double smallest = std::numeric_limits<double>::infinity();
    std::vector<double> weights(all.errors, 1.0);
    for (int step = 0; step < steps; ++step) {
        const std::vector<double> P = precisions(all, numbers), errors = errors_with(all, P);
        const double of_sum = error_of_sum(all, errors), size = least_of(all, errors, of_sum, least);
        if (size < smallest) {
            smallest = size;
            best = numbers;
        }
        for (std::size_t k = 0; k < all.errors; ++k) switch (least.of) {
                case LeastError::Of::bounces:
                    weights[k] *= std::sqrt(errors[k] / size);
                    break;
                case LeastError::Of::sum:
                    weights[k] = all.sizes[k];
                    break;
                case LeastError::Of::all:
                    weights[k] = 1.0 / errors[k] + all.sizes[k] / of_sum;
                    break;
            }
        for (std::size_t m = 0; m < all.methods; ++m) {
            std::vector<double> gains(all.blocks, 0.0);
            for (std::size_t k = 0; k < all.errors; ++k)
                for (std::size_t b = 0; b < all.blocks; ++b) {
                    const double p = P[k * all.blocks + b];
                    gains[b] += weights[k] / (all.variance(m, k, b) * p * p);
                }
            const auto costs = std::span(all.costs).subspan(m * all.blocks, all.blocks);
            const bool even = !all.even.empty() && all.even[m];
            const double of_all =
                std::accumulate(gains.begin(), gains.end(), 0.0) / std::accumulate(costs.begin(), costs.end(), 0.0);
            for (std::size_t b = 0; b < all.blocks; ++b)
                numbers[m * all.blocks + b] *= std::sqrt(even ? of_all : gains[b] / costs[b]);
        }
        spend(all, numbers);
    }
    return best;
}

std::vector<double> weights_of(const MixtureCosts& all, const std::vector<double>& numbers) {
    const std::vector<double> P = precisions(all, numbers);
    std::vector<double> weights(all.variances.size());
    for (std::size_t m = 0; m < all.methods; ++m)
        for (std::size_t k = 0; k < all.errors; ++k)
            for (std::size_t b = 0; b < all.blocks; ++b) {
                const double p = P[k * all.blocks + b];
                weights[(m * all.errors + k) * all.blocks + b] =
                    p > 0.0 ? numbers[m * all.blocks + b] / (all.variance(m, k, b) * p) : 1.0 / static_cast<double>(all.methods);
            }
    return weights;
}

std::vector<double> shares_of(const MixtureCosts& all, const std::vector<double>& numbers) {
    std::vector<double> shares(all.methods, 0.0);
    double cost = 0.0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        shares[i / all.blocks] += all.costs[i] * numbers[i];
        cost += all.costs[i] * numbers[i];
    }
    for (double& share : shares) share /= cost;
    return shares;
}

double least_of(const MixtureCosts& all, const std::vector<double>& numbers, LeastError least) {
    const std::vector<double> errors = errors_with(all, precisions(all, numbers));
    return least_of(all, errors, error_of_sum(all, errors), least);
}

MixtureCosts without(const MixtureCosts& all, std::size_t method) {
    MixtureCosts left = all;
    const auto cut = [method](std::vector<double>& of, std::size_t stride) {
        const auto begin = of.begin() + static_cast<std::ptrdiff_t>(method * stride);
        of.erase(begin, begin + static_cast<std::ptrdiff_t>(stride));
    };
    cut(left.variances, all.errors * all.blocks);
    cut(left.costs, all.blocks);
    if (!left.even.empty()) left.even.erase(left.even.begin() + static_cast<std::ptrdiff_t>(method));
    --left.methods;
    return left;
}

std::vector<double> errors_of(const MixtureCosts& all, const std::vector<double>& numbers) {
    return errors_with(all, precisions(all, numbers));
}

}  // namespace neumann
