// Distributes the samples of a picture over its pixels, by a pilot whose own samples are used for nothing else, so that
// the picture stays unbiased.
//
// Let V_kb be the variance of a sample of bounce k in block b, as a part of the bounce's squared size, c_b the cost of
// a sample, and s_b the samples in each pixel. The error of bounce k is e_k² = Σ_b V_kb / s_b. At given cost Σ_b c_b
// s_b the largest of these errors is least where
//
//     s_b ∝ √(Σ_k λ_k V_kb / c_b),     λ_k ≥ 0,  Σ λ_k = 1,  λ_k > 0 only for the bounces with the largest error;
//
// λ is found by making it larger where the error is above the mean, again and again. For the sum there is one V. The
// largest error of a bounce, M, times the geometric mean of the errors of all K bounces and of the sum is least where
// λ_k ∝ 1 / ((K + 1) e_k²) + μ_k / M, with μ as λ for the largest error, and 0 for the sum.
#pragma once

#include "operators/render/from_paths/least_error.h"
#include "operators/render/from_paths/sampling_settings.h"
#include "operators/watch.h"

#include <span>
#include <vector>

namespace neumann {

// V_kb for each k, block by block, and c_b.
struct BlockCosts {
    std::size_t blocks = 0;
    std::vector<double> variances, costs;

    std::size_t errors() const { return variances.size() / blocks; }
    std::span<const double> variance(std::size_t k) const { return std::span(variances).subspan(k * blocks, blocks); }
};

// The s_b that minimise `least`, with Σ c_b s_b = Σ c_b, for the variances of bounces, of the sum, or of both, sum last.
std::vector<double> best_numbers(const BlockCosts& costs, LeastError least);
// The powers of 2 nearest to σ s_b, as exponents within ±most, with the largest σ at which they cost no more than
// `budget`. `below`: what becomes of smaller exponents: −most, or no samples.
enum class Below { least, none };
std::vector<std::int8_t> as_powers(const std::vector<double>& numbers, std::span<const double> costs, double budget, int most,
                                   Below below = Below::least);

// Allocates samples for walks, among them guided and corrected ones, and for the bidirectional method. The result is
// the same for all seeds, except that the seed makes guides and fields. Throws Stopped if `watch` stops it.
std::shared_ptr<const Allocation> allocate(const Scene& scene, const SamplingSettings& settings, LeastError least,
                                           const Watch& watch = {});

}  // namespace neumann
