// L = Le + K L  ⇒  L = Le + K Le + K² Le + …
#pragma once

#include "operators/algebra/algebra.h"
#include "operators/algebra/compensated_sum.h"

namespace neumann {

// Steps through the terms K^i Le and the partial sums of any operator that maps a kind of field to itself.
template <Endomorphism Op>
class NeumannSeries {
public:
    using Field = typename Op::Domain;

    NeumannSeries(Op K, Field Le) : K_(std::move(K)), term_(Le), before_(Le), sum_(std::move(Le)) {}

    int bounce() const { return bounce_; }           // i
    const Field& term() const { return term_; }      // K^i Le
    const Field& before() const { return before_; }  // K^(i−1) Le, for i ≥ 1
    Field sum() const { return sum_.value(); }       // Σ_{k≤i} K^k Le, compensated

    void advance() {
        before_ = std::move(term_);
        term_ = K_(std::as_const(before_));
        sum_.add(term_);
        ++bounce_;
    }

private:
    Op K_;
    Field term_, before_;
    CompensatedSum<Field> sum_;
    int bounce_ = 0;
};

}  // namespace neumann
