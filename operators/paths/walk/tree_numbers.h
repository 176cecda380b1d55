// How many samples to take at each depth of a path from the camera: the open question of "given a number of rays, where should they
// go?" for a tree whose branches are equal.
//
// A sample at depth j ≥ 1 is a light sample and a direction at the j-th vertex; at depth 0 it is a camera ray. With X the value of
// a path and F_j what is known after depth j, X splits into parts of variance
//
//     D_j = E Var(E[X | F_j] | F_{j−1}),
//
// and a tree with m_j samples at depth j has the variance Σ_j D_j / m_j, its branches being independent once they part, at the cost
// Σ_j c_j m_j (Bolin and Meyer, An Error Metric for Monte Carlo Ray Tracing, 1997). Fewer samples than at the depth before are
// Russian roulette, which adds S_j (1/m_j − 1/m_{j−1}) with S_j = E[(E[X_{≥j} | F_{j−1}])²], X_{≥j} being what depth j and later
// ones bring (Rath, Grittmann, Herholz, Weier, Slusallek, EARS, 2022). Where depths change by splitting, by roulette or not at all
// is a choice of three at each; for a choice the best numbers have a closed form, m ∝ √(E/c) of the joined depths, with variance ×
// cost (Σ √(E c))².
#pragma once

#include <span>
#include <vector>

namespace neumann {

// Of depths 0 … N. Any unit of variance and of cost.
struct TreeMoments {
    std::vector<double> variance, remainder, cost;  // D_j, S_j (S_0 is not used) and c_j
    std::size_t depths() const { return variance.size(); }
};

// Variance × cost of m_j samples at depth j for each camera ray, m_0 = 1.
double work_of(const TreeMoments& tree, std::span<const double> numbers);
// The numbers for each camera ray that make it least. At most 10 depths: the choices are tried one by one.
std::vector<double> best_tree(const TreeMoments& tree);

// What a tree costs, in walks: Σ_j c_j m_j / Σ_j c_j, with ratios[j − 1] = m_j / m_{j−1}, and 1 for deeper ones. `cost`: c_j, of
// depths 0 ….
double walks_of_tree(std::span<const double> ratios, std::span<const double> cost);

}  // namespace neumann
