#include "tests/search/measured.h"

#include <gtest/gtest.h>

#include <limits>

namespace neumann::search::comparisons_test {

// A bounce of one value in all parts.
Measured measured(double mean, double error, double bias = 0.0) {
    Measured m;
    m.samples = 1e6;
    Claim claim;
    claim.mean = {mean, error, std::numeric_limits<double>::infinity()};
    claim.bias = bias;
    m.bounces.emplace_back();
    m.bounces.back().fill(claim);
    return m;
}

TEST(Comparisons, AProbabilityIsThatOfTheNormalDistribution) {
    // 5 standard errors of the difference of two: 2 (1 − Φ(5)) = 5.73303·10⁻⁷, but for what rounding and single samples may change.
    EXPECT_NEAR(compare(measured(1.0, 0.003), measured(1.025, 0.004)).probability, 5.73303e-7, 2e-8);
    EXPECT_EQ(compare(measured(1.0, 0.003), measured(1.0, 0.004)).probability, 1.0);
    EXPECT_EQ(compare(measured(1.0, 0.0), measured(1.001, 0.0)).probability, 0.0);
    EXPECT_EQ(compare(measured(1.0, 0.0), measured(1.000001, 0.0)).probability, 1.0);
}

TEST(Comparisons, ABiasIsAllowedThreeTimes) {
    EXPECT_EQ(compare(measured(1.0, 0.001, 0.01), measured(1.029, 0.001)).probability, 1.0);
    EXPECT_LT(compare(measured(1.0, 0.001, 0.01), measured(1.04, 0.001)).probability, 1e-9);
}

TEST(Comparisons, WhatMissesPathsMayBeLessAndNotMore) {
    Measured some = measured(1.0, 0.001);
    some.misses_paths = true;
    EXPECT_EQ(compare(some, measured(2.0, 0.001)).probability, 1.0);
    EXPECT_LT(compare(some, measured(0.9, 0.001)).probability, 1e-9);
    EXPECT_LT(compare(measured(0.9, 0.001), some).probability, 1e-9);
}

TEST(Comparisons, WhatNoSampleMetMayBeUpToSixTimesItsBound) {
    Measured none = measured(0.0, 0.0);
    for (Claim& claim : none.bounces[0]) claim.unmet = 0.01;
    EXPECT_EQ(compare(none, measured(0.059, 0.0001)).probability, 1.0);
    EXPECT_LT(compare(none, measured(0.062, 0.0001)).probability, 1e-9);
    EXPECT_LT(compare(measured(0.062, 0.0001), none).probability, 1e-9);
}

TEST(Comparisons, WhatStatesNoIntervalIsNotCompared) {
    Measured open = measured(1.0, 0.001);
    for (Claim& claim : open.bounces[0]) claim.holds = false;
    EXPECT_EQ(compare(open, measured(2.0, 0.001)).probability, 1.0);
}

}  // namespace neumann::search::comparisons_test
