// Independent uniform numbers in [0, 1), drawn dimension by dimension.
#pragma once

#include "core/base/vec.h"
#include "core/sampling/counter_based.h"

namespace neumann {

class IndependentSampler {
public:
    IndependentSampler(std::uint64_t seed, std::uint32_t pixel) : random_(seed, pixel) {}

    void start(std::uint64_t sample) {
        sample_ = sample;
        block_ = 0;
        left_ = 0;
    }
    double next() {
        if (left_ == 0) {
            bits_ = random_(sample_, block_++);
            left_ = 4;
        }
        return to_unit_interval(bits_[4 - left_--]);
    }
    Vec2 next2() {
        const double x = next();
        return {x, next()};
    }

private:
    CounterBased random_;
    std::uint64_t sample_ = 0;
    std::uint32_t block_ = 0;
    unsigned left_ = 0;
    std::array<std::uint32_t, 4> bits_{};
};

}  // namespace neumann
