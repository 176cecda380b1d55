// Mixes several unbiased methods in the best way over the blocks of a picture and its bounces.
//
// Let V_mkb be the variance of a sample by method m of bounce k in block b, as a part of the bounce's squared size,
// c_mb the cost of the sample, and s_mb the samples in each pixel. The means are weighted by their precision,
//
//     w_mkb = (s_mb / V_mkb) / P_kb,   P_kb = Σ_m s_mb / V_mkb,      and the error of bounce k is  e_k² = Σ_b 1 / P_kb.
//
// This is convex in s. At given cost Σ c_mb s_mb a mean of the e_k² with weights λ_k is least where
//
//     g_mb = Σ_k λ_k / (V_mkb P_kb²)   is c_mb times the same for all s_mb > 0.
//
// Let r_k be the squared size of bounce k as a part of the sum's. Bounces count as if they were independent, so that
// the sum's error is e² = Σ_k r_k e_k². These λ minimise
//
//     the sum's error                          λ_k = r_k
//     the product of that and all bounces'     λ_k ∝ 1/e_k² + r_k/e²
//     the largest of a bounce                  λ_k > 0 only for the bounces with the largest error
//
// s is found by multiplying s_mb by √(g_mb / c_mb) again and again, as in the design of experiments (Titterington 1976;
// Yu 2010), and λ of the largest error by making it larger where the error is above the mean, in the same steps. A
// method that has equally many samples in all blocks is multiplied by √(Σ_b g_mb / Σ_b c_mb). MARS (Grittmann et al.
// 2024) likewise chooses numbers of samples of techniques by pilots; there techniques share their paths' weights, here
// each method is an estimator of its own.
#pragma once

#include "operators/render/from_paths/least_error.h"

#include <cstddef>
#include <vector>

namespace neumann {

struct MixtureCosts {
    std::size_t methods = 0, errors = 0, blocks = 0;
    std::vector<double> variances;  // V_mkb > 0, method by method, bounce by bounce
    std::vector<double> costs;      // c_mb, method by method
    std::vector<double> sizes;      // r_k
    double budget = 1.0;            // Σ_mb c_mb s_mb
    std::vector<bool> even = {};    // the methods whose s_mb must be the same for all b; empty: none

    double& variance(std::size_t m, std::size_t k, std::size_t b) { return variances[(m * errors + k) * blocks + b]; }
    double variance(std::size_t m, std::size_t k, std::size_t b) const { return variances[(m * errors + k) * blocks + b]; }
};

// s_mb, method by method.
std::vector<double> best_mixture(const MixtureCosts& costs, LeastError least);
// w_mkb, arranged as the variances; if s_mb = 0 for all m, the methods have equal weights.
std::vector<double> weights_of(const MixtureCosts& costs, const std::vector<double>& numbers);
// The e_k² with these numbers.
std::vector<double> errors_of(const MixtureCosts& costs, const std::vector<double>& numbers);
// The quantity that best_mixture() minimises: the largest e_k², e², or the geometric mean of e² and all e_k². (Unlike
// the last in allocation.h, the geometric mean is not multiplied by the largest e_k²: pilots know that least, and would
// trust a method where it missed its paths.)
double least_of(const MixtureCosts& costs, const std::vector<double>& numbers, LeastError least);
// Each method's part of the cost.
std::vector<double> shares_of(const MixtureCosts& costs, const std::vector<double>& numbers);
// The costs without those of one method.
MixtureCosts without(const MixtureCosts& costs, std::size_t method);

}  // namespace neumann
