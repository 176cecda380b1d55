// Pseudo-random vectors that are always the same.
#pragma once

#include "operators/algebra/channel_operator.h"

#include <random>

namespace neumann {

class FixedNumbers {
public:
    // The next vector for K, with values in [−1, 1). Each of the processes that share K gets its part of the same vector.
    void fill(const ChannelOperator& K, Vector& x) {
        const auto own = static_cast<std::size_t>(K.size());
        x.resize(K.size());
        bits_.discard(K.first());
        fill(x);
        bits_.discard(K.unknowns() - K.first() - own);
    }
    void fill(Vector& x) {
        for (double& value : x) value = static_cast<double>(bits_() >> 11) * 0x1p-52 - 1.0;
    }

private:
    std::mt19937_64 bits_{1};
};

}  // namespace neumann
