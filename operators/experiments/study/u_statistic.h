// U = mean_{j≠k} G_jk of a symmetric matrix G_jk = h(x_j, x_k), and its standard error. Hoeffding, A Class of Statistics with
// Asymptotically Normal Distribution, 1948:
//
//     Var U = 4 (R−2) / (R (R−1)) ζ₁ + 2 / (R (R−1)) ζ₂,    ζ₁ = Cov(G_jk, G_jl),  ζ₂ = Var G_jk
//
// Both terms are needed, because ζ₁ vanishes if there is no bias. ζ₁ and ζ₂ are estimated without bias, from products of elements
// with no index or one index in common. A negative estimate of ζ₁ is replaced by 0, which can only enlarge the error.
#pragma once

#include <cstddef>
#include <vector>

namespace neumann {

class SymmetricMatrix {
public:
    explicit SymmetricMatrix(std::size_t size) : size_(size), values_(size * size) {}
    std::size_t size() const { return size_; }
    double operator()(std::size_t j, std::size_t k) const { return values_[j * size_ + k]; }
    void set(std::size_t j, std::size_t k, double value) { values_[j * size_ + k] = values_[k * size_ + j] = value; }

private:
    std::size_t size_;
    std::vector<double> values_;
};

// The size must be at least 2.
double u_statistic(const SymmetricMatrix& g);
// Infinite for a size below 4.
double u_statistic_error(const SymmetricMatrix& g);

}  // namespace neumann
