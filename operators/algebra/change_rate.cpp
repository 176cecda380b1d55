#include "operators/algebra/change_rate.h"

#include <algorithm>
#include <cmath>

namespace neumann {

void ChangeRate::add(double change) {
    changes_.push_back(change);
    const std::size_t n = changes_.size() - 1;
    rate_ = change == 0.0 ? 0.0 : std::numeric_limits<double>::infinity();
    if (n == 0 || change == 0.0) return;
    rate_ = 0.0;
    for (std::size_t k = 1; k <= std::min<std::size_t>(n, 8); ++k) {
        if (changes_[n - k] > 0.0) rate_ = std::max(rate_, std::pow(change / changes_[n - k], 1.0 / static_cast<double>(k)));
    }
}

double ChangeRate::estimate() const {
    return rate_ < 1.0 ? changes_.back() * rate_ / (1.0 - rate_) : std::numeric_limits<double>::infinity();
}

bool ChangeRate::not_falling() const {
    constexpr std::size_t window = 32;
    // The tolerance is there because rounding moves the terms of a furnace of albedo 1 by some 10⁻¹⁶ a bounce.
    return changes_.size() > window && !(changes_.back() < (1.0 - 1e-12) * changes_[changes_.size() - 1 - window]);
}

}  // namespace neumann
