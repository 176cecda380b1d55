// L = Le + K L  ⇒  L = Le + K Le + K² Le + …
#pragma once

#include "operators/series/product.h"

namespace neumann {

// Steps through the terms K^i Le and the partial sums of any operator that maps a kind of field to itself.
template <Operator Op>
requires std::same_as<typename Op::Domain, typename Op::Range>
class NeumannSeries {
public:
    using Field = typename Op::Domain;

    NeumannSeries(Op K, Field Le) : K_(std::move(K)), term_(Le), sum_(std::move(Le)) {}

    int bounce() const { return bounce_; }       // i
    const Field& term() const { return term_; }  // K^i Le
    const Field& sum() const { return sum_; }    // Σ_{k≤i} K^k Le

    void advance() {
        term_ = K_(term_);
        sum_ = sum_ + term_;
        ++bounce_;
    }

private:
    Op K_;
    Field term_, sum_;
    int bounce_ = 0;
};

}  // namespace neumann
