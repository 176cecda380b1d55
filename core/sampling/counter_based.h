// Counter-based random numbers: a pure function of (seed, pixel, sample, dimension), so pictures do not depend on threads or on how
// a run was cut into pieces. Philox2x64 of Salmon et al., Parallel Random Numbers: As Easy as 1, 2, 3 (2011), from Random123, with
// one round more than the six that pass TestU01's BigCrush.
#pragma once

#include <Random123/philox.h>

#include <array>
#include <cstdint>

namespace neumann {

class CounterBased {
public:
    CounterBased(std::uint64_t seed, std::uint32_t pixel) : key_{{seed}}, pixel_(pixel) {}

    // Four numbers for the dimensions 4·block … 4·block + 3.
    std::array<std::uint32_t, 4> operator()(std::uint64_t sample, std::uint32_t block) const {
        const auto bits = r123::Philox2x64_R<7>()({{sample, std::uint64_t{pixel_} << 32 | block}}, key_);
        return {static_cast<std::uint32_t>(bits[0]), static_cast<std::uint32_t>(bits[0] >> 32), static_cast<std::uint32_t>(bits[1]),
                static_cast<std::uint32_t>(bits[1] >> 32)};
    }

private:
    r123::Philox2x64::key_type key_;
    std::uint32_t pixel_;
};

}  // namespace neumann
