#pragma once

#include <limits>
#include <vector>

namespace neumann {

// Estimates the error of a series from its terms, or of an iteration from its changes ‖d_n‖, if the error falls like
// q^n: ‖d_n‖ q/(1−q), with q the largest mean rate over the last 1 … 8 changes. This is not a bound: a slow component
// that is still small is not seen (0.5^n + 10⁻⁶ · 0.99^n).
class ChangeRate {
public:
    void add(double change);
    double estimate() const;   // infinite before there are two changes, and if q ≥ 1
    bool not_falling() const;  // the changes did not get smaller over the last 32
    double rate() const { return rate_; }

private:
    std::vector<double> changes_;
    double rate_ = std::numeric_limits<double>::infinity();
};

}  // namespace neumann
