// Sums that keep what ordinary addition rounds away, for each component by itself.
//
// A. Neumaier, Rundungsfehleranalyse einiger Verfahren zur Summation endlicher Summen, ZAMM 54 (1974): the lost low-order part of
// each addition is collected and added at the end. Error 2ε + O(n²ε²) Σ|t|/|Σ t| instead of O(nε).
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace neumann {

template <class Real>
class CompensatedSum {
public:
    using Values = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

    explicit CompensatedSum(Eigen::Index size) : sum_(Values::Zero(size)), lost_(Values::Zero(size)) {}

    void add(const Values& term) {
        for (Eigen::Index u = 0; u < sum_.size(); ++u) {
            const Real t = term[u], s = sum_[u] + t;
            lost_[u] += std::abs(sum_[u]) >= std::abs(t) ? (sum_[u] - s) + t : (t - s) + sum_[u];
            sum_[u] = s;
        }
    }
    Values value() const { return sum_ + lost_; }

private:
    Values sum_, lost_;
};

}  // namespace neumann
