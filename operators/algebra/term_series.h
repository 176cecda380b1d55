// The terms t_n = K^n Le and the partial sums S_n = Σ_{k≤n} t_k of one channel, for the K of a solver.
#pragma once

#include "operators/algebra/channel_operator.h"
#include "operators/algebra/neumann_series.h"

namespace neumann {

// A reference to K, as an operator of the algebra.
class ChannelReference {
public:
    using Domain = Vector;
    using Range = Vector;

    ChannelReference(const ChannelOperator& K) : K_(&K) {}
    Vector operator()(const Vector& x) const {
        Vector y(x.size());
        K_->apply(x, y);
        return y;
    }

private:
    const ChannelOperator* K_;
};

using TermSeries = NeumannSeries<ChannelReference>;

}  // namespace neumann
