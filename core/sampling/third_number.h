// Derives a random number from two others.
#pragma once

#include "core/base/vec.h"

#include <bit>
#include <cstdint>

namespace neumann {

// A number uniform in [0, 1) and practically independent of u, for a choice in addition to those made with u. The bits of both
// numbers are mixed by the finaliser of SplitMix64: Steele, Lea and Flood, Fast Splittable Pseudorandom Number Generators, 2014.
inline double third_number(const Vec2& u) {
    const auto mixed = [](std::uint64_t x) {
        x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
        x = (x ^ x >> 27) * 0x94d049bb133111ebu;
        return x ^ x >> 31;
    };
    return static_cast<double>(mixed(mixed(std::bit_cast<std::uint64_t>(u.x)) ^ std::bit_cast<std::uint64_t>(u.y)) >> 11) * 0x1p-53;
}

}  // namespace neumann
