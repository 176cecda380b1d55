// How the samples of a picture are best distributed over its pixels, by a pilot whose own samples are not used for anything else,
// so that the picture stays unbiased.
//
// With V_kb the variance of a sample of bounce k in block b, as a part of the bounce's squared size, c_b what a sample costs, and
// s_b samples in each pixel, the error of bounce k is e_k² = Σ_b V_kb / s_b. At given cost Σ_b c_b s_b the largest of these errors
// is least where
//
//     s_b ∝ √(Σ_k λ_k V_kb / c_b),     λ_k ≥ 0,  Σ λ_k = 1,  λ_k > 0 only for the bounces with the largest error;
//
// λ is found by making it larger where the error is above the mean, again and again. For the sum there is one V. The largest error
// of a bounce, M, times the geometric mean of those of all K bounces and of the sum is least where λ_k ∝ 1 / ((K + 1) e_k²) + μ_k /
// M, with μ as λ for the largest error, and 0 for the sum.
#pragma once

#include "operators/render/from_paths/least_error.h"
#include "operators/render/from_paths/sampling_settings.h"
#include "operators/watch.h"

#include <span>
#include <vector>

namespace neumann {

// V_kb for each k, k by k, and c_b.
struct BlockCosts {
    std::size_t blocks = 0;
    std::vector<double> variances, costs;

    std::size_t errors() const { return variances.size() / blocks; }
    std::span<const double> variance(std::size_t k) const { return std::span(variances).subspan(k * blocks, blocks); }
};

// s_b that make `least` least, with Σ c_b s_b = Σ c_b. The errors are those of bounces, of the sum, or of bounces and, last, of the
// sum.
std::vector<double> best_numbers(const BlockCosts& costs, LeastError least);
// The nearest powers of 2 to σ s_b, as exponents within ±most, with the largest σ for which they cost no more than `budget`. What
// is below is as much as allowed, or none.
enum class Below { least, none };
std::vector<std::int8_t> as_powers(const std::vector<double>& numbers, std::span<const double> costs, double budget, int most,
                                   Below below = Below::least);

// For walks, guided ones and corrected ones among them, and the bidirectional method. By guides and fields as the seed has made
// them, and otherwise the same for all seeds. Throws Stopped if `watch` stops it.
std::shared_ptr<const Allocation> allocate(const Scene& scene, const SamplingSettings& settings, LeastError least,
                                           const Watch& watch = {});

}  // namespace neumann
