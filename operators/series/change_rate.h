// What the terms of a series, or the changes of an iteration, tell of the error that is left.
#pragma once

#include <limits>
#include <vector>

namespace neumann {

// Turns the changes ‖d_n‖ of an iteration whose error falls like q^n into an error: ‖d_n‖ q/(1−q), with q the largest mean rate
// over the last 1 … 8 changes. An estimate and no bound: a slow component that is still small hides (0.5^n + 10⁻⁶ · 0.99^n).
class ChangeRate {
public:
    void add(double change);
    double estimate() const;   // infinite until there are two changes, and where q ≥ 1
    bool not_falling() const;  // the changes did not get smaller over the last 32
    double rate() const { return rate_; }

private:
    std::vector<double> changes_;
    double rate_ = std::numeric_limits<double>::infinity();
};

}  // namespace neumann
