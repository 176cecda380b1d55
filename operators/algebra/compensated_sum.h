// Compensated summation, component by component.
//
// A. Neumaier, Rundungsfehleranalyse einiger Verfahren zur Summation endlicher Summen, ZAMM 54 (1974): the lost low-order part of
// each addition is collected and added at the end. Error 2ε + O(n²ε²) Σ|t|/|Σ t| instead of O(nε).
#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace neumann {

// Adds t to `sum`, and the rounding error of that addition to `lost`.
template <class Real>
void add_compensated(Real& sum, Real& lost, Real t) {
    const Real s = sum + t;
    lost += std::abs(sum) >= std::abs(t) ? (sum - s) + t : (t - s) + sum;
    sum = s;
}

// The sum of fields stored as size() numbers at data(). The sum of functions is in operators/pointwise/field.h.
template <class Field>
class CompensatedSum {
public:
    explicit CompensatedSum(Field first) : sum_(std::move(first)), lost_(static_cast<std::size_t>(sum_.size())) {}

    void add(const Field& term) {
        for (std::size_t u = 0; u < lost_.size(); ++u) add_compensated(sum_.data()[u], lost_[u], term.data()[u]);
    }
    Field value() const {
        Field all = sum_;
        for (std::size_t u = 0; u < lost_.size(); ++u) all.data()[u] += lost_[u];
        return all;
    }

private:
    using Real = std::remove_cvref_t<decltype(*std::declval<Field&>().data())>;
    Field sum_;
    std::vector<Real> lost_;
};

}  // namespace neumann
