// The terms t_n = K^n Le and the partial sums S_n = Σ_{k≤n} t_k of any K on a vector of unknowns.
#pragma once

#include "operators/series/compensated_sum.h"
#include "operators/solvers/channel_operator.h"

namespace neumann {

// L1, L2 and L∞ of a vector: power Σ m|t| (W, where t is radiance and m area times projected solid angle), (Σ m t²)^½ and max |t|.
struct TermNorms {
    double power = 0.0, l2 = 0.0, sup = 0.0;
};

inline TermNorms norms(const Vector& t, const Vector& measure) {
    if (t.size() == 0) return {};
    return {measure.dot(t.cwiseAbs()), std::sqrt(measure.dot(t.cwiseAbs2())), t.lpNorm<Eigen::Infinity>()};
}

class TermSeries {
public:
    // K is kept by reference.
    TermSeries(const ChannelOperator& K, const Vector& Le) : K_(&K), term_(Le), before_(Vector::Zero(Le.size())), sum_(Le.size()) {
        sum_.add(term_);
    }

    int bounce() const { return bounce_; }            // n
    const Vector& term() const { return term_; }      // t_n
    const Vector& before() const { return before_; }  // t_{n−1}, 0 for n = 0
    Vector sum() const { return sum_.value(); }       // S_n
    TermNorms term_norms() const { return norms(term_, K_->measure()); }

    void advance() {
        std::swap(term_, before_);
        K_->apply(before_, term_);
        sum_.add(term_);
        ++bounce_;
    }

private:
    const ChannelOperator* K_;
    Vector term_, before_;
    CompensatedSum<double> sum_;
    int bounce_ = 0;
};

}  // namespace neumann
