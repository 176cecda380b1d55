// IEEE 754 half floats, for pictures that have to be small.
#pragma once

#include <cstdint>

namespace neumann {

// The bits of the half float nearest to `value`, ties to even: 11 bits from 2⁻¹⁴ on, multiples of 2⁻²⁴ below. Infinite from 65520
// on.
std::uint16_t half_bits(float value);

}  // namespace neumann
