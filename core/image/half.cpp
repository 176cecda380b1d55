#include "core/image/half.h"

#include <bit>

namespace neumann {

std::uint16_t half_bits(float value) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(value), sign = (bits >> 16) & 0x8000u, size = bits & 0x7fffffffu;
    std::uint32_t half;
    if (size > 0x7f800000u) {
        half = 0x7e00u;
    } else if (size >= 0x477ff000u) {  // 65520, halfway from the largest half to 2¹⁶
        half = 0x7c00u;
    } else if (size < 0x38800000u) {  // below 2⁻¹⁴: floats from 1/2 to 1 are multiples of 2⁻²⁴, and addition rounds to them
        half = std::bit_cast<std::uint32_t>(std::bit_cast<float>(size) + 0.5f) - 0x3f000000u;
    } else {  // 13 bits fewer, and the exponent counted from −15 in place of −127
        half = (size - 0x38000000u + 0xfffu + ((size >> 13) & 1u)) >> 13;
    }
    return static_cast<std::uint16_t>(sign | half);
}

}  // namespace neumann
