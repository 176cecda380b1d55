// How many pixels, side by side, use the tails of each other's walks (reusing_walk.h). More of them cost more rays than they save,
// in most scenes (tests/bench/bench_reuse.cpp).
#pragma once

#include <cstdint>

namespace neumann {

inline constexpr std::uint32_t sharing_pixels = 8;

}  // namespace neumann
