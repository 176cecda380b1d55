// The best numbers of samples at each depth of a path from the camera: where a given number of rays should go, for a
// tree whose branches are equal.
//
// A sample at depth j ≥ 1 is a light sample and a direction at the j-th vertex; at depth 0 it is a camera ray. With X
// the value of a path and F_j the information after depth j, X splits into parts of variance
//
//     D_j = E Var(E[X | F_j] | F_{j−1}),
//
// and a tree with m_j samples at depth j, whose branches are independent once they part, has the variance Σ_j D_j / m_j
// at the cost Σ_j c_j m_j (Bolin and Meyer, An Error Metric for Monte Carlo Ray Tracing, 1997). Fewer samples than at
// the previous depth are Russian roulette, which adds S_j (1/m_j − 1/m_{j−1}) with S_j = E[(E[X_{≥j} | F_{j−1}])²],
// where X_{≥j} is the contribution of depth j and later ones (Rath, Grittmann, Herholz, Weier, Slusallek, EARS, 2022).
// At each depth there are three choices: splitting, Russian roulette, or no change. For given choices the best numbers
// have a closed form, m ∝ √(E/c) of the joined depths, with variance × cost (Σ √(E c))².
#pragma once

#include <span>
#include <vector>

namespace neumann {

// The moments of depths 0 … N, in any unit of variance and of cost.
struct TreeMoments {
    std::vector<double> variance, remainder, cost;  // D_j, S_j (S_0 is not used) and c_j
    std::size_t depths() const { return variance.size(); }
};

// The variance × cost of m_j samples at depth j for each camera ray, m_0 = 1.
double work_of(const TreeMoments& tree, std::span<const double> numbers);
// The numbers for each camera ray for which work_of() is least. At most 10 depths, because the choices are tried one by one.
std::vector<double> best_tree(const TreeMoments& tree);

// The cost of a tree in walks: Σ_j c_j m_j / Σ_j c_j, with ratios[j − 1] = m_j / m_{j−1}, and 1 for deeper ones. `cost`
// has c_j for depths 0 ….
double walks_of_tree(std::span<const double> ratios, std::span<const double> cost);

}  // namespace neumann
