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
        if (left_ == 0) refill();
        return to_unit_interval(bits_[4 - left_--]);
    }
    // Both numbers come from the same block; a single number left over is skipped.
    Vec2 next2() {
        if (left_ < 2) refill();
        const unsigned at = 4 - left_;
        left_ -= 2;
        return {to_unit_interval(bits_[at]), to_unit_interval(bits_[at + 1])};
    }

private:
    void refill() {
        bits_ = random_(sample_, block_++);
        left_ = 4;
    }

    CounterBased random_;
    std::uint64_t sample_ = 0;
    std::uint32_t block_ = 0;
    unsigned left_ = 0;
    std::array<std::uint32_t, 4> bits_{};
};

}  // namespace neumann
