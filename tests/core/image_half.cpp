// Half floats by their definition: the nearest of all 65536.
#include "core/image/half.h"

#include <gtest/gtest.h>
#include <cmath>
#include <limits>

namespace neumann {
namespace {

// What the bits of a finite half stand for; exact.
double value_of(std::uint16_t bits) {
    const int exponent = (bits >> 10) & 31, fraction = bits & 1023;
    const double size = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
    return bits & 0x8000 ? -size : size;
}

TEST(ImageHalf, EveryHalfIsItself) {
    for (std::uint32_t bits = 0; bits < 0x10000; ++bits) {
        if (((bits >> 10) & 31) == 31) continue;
        EXPECT_EQ(half_bits(static_cast<float>(value_of(static_cast<std::uint16_t>(bits)))), bits);
    }
}

// Midpoints of neighbours are floats; there the even one is taken, and on both sides of them the nearer one.
TEST(ImageHalf, RoundsToTheNearestAndTiesToEven) {
    for (std::uint32_t bits = 0; bits < 0x7bff; ++bits) {
        const auto low = static_cast<std::uint16_t>(bits), high = static_cast<std::uint16_t>(bits + 1);
        const auto middle = static_cast<float>((value_of(low) + value_of(high)) / 2);
        EXPECT_EQ(half_bits(middle), low % 2 == 0 ? low : high);
        EXPECT_EQ(half_bits(std::nextafter(middle, 0.0f)), low);
        EXPECT_EQ(half_bits(std::nextafter(middle, 1e6f)), high);
        EXPECT_EQ(half_bits(-middle), 0x8000 | (low % 2 == 0 ? low : high));
    }
}

TEST(ImageHalf, WhatIsTooLargeOrNoNumber) {
    EXPECT_EQ(half_bits(std::nextafter(65520.0f, 0.0f)), 0x7bff);
    EXPECT_EQ(half_bits(65520.0f), 0x7c00);
    EXPECT_EQ(half_bits(-std::numeric_limits<float>::infinity()), 0xfc00);
    EXPECT_EQ(half_bits(std::numeric_limits<float>::quiet_NaN()), 0x7e00);
}

}  // namespace
}  // namespace neumann
