// The terms t_n = K^n Le and the partial sums S_n = Σ_{k≤n} t_k of one channel: the series of whatever a solver is given.
#pragma once

#include "operators/series/neumann_series.h"
#include "operators/solvers/channel_operator.h"

namespace neumann {

// K kept by reference, as an operator.
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
