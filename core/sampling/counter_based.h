// Counter-based random numbers: a pure function of (seed, pixel, sample, dimension), so pictures do not depend on threads or on how
// a run was cut into pieces. Philox4x32-10 of Salmon et al., Parallel Random Numbers: As Easy as 1, 2, 3 (2011), from Random123.
#pragma once

#include <Random123/philox.h>

#include <array>
#include <cstdint>

namespace neumann {

inline double to_unit_interval(std::uint32_t bits) { return bits * 0x1p-32; }  // [0, 1)

class CounterBased {
public:
    CounterBased(std::uint64_t seed, std::uint32_t pixel)
        : key_{{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}}, pixel_(pixel) {}

    // Four numbers for the dimensions 4·block … 4·block + 3.
    std::array<std::uint32_t, 4> operator()(std::uint64_t sample, std::uint32_t block) const {
        const r123::Philox4x32::ctr_type counter{
            {block, static_cast<std::uint32_t>(sample), pixel_, static_cast<std::uint32_t>(sample >> 32)}};
        const auto bits = r123::Philox4x32()(counter, key_);
        return {bits[0], bits[1], bits[2], bits[3]};
    }

private:
    r123::Philox4x32::key_type key_;
    std::uint32_t pixel_;
};

}  // namespace neumann
