#include "operators/statistics/few_events.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

namespace neumann::few_events_test {

// Upper ends of Poisson's exact two-sided 95% interval (Garwood, Biometrika 28, 1936).
TEST(FewEvents, AreThoseOfPoissonWhereEventsAreAlike) {
    for (const auto& [events, upper] : {std::pair{0, 3.689}, {1, 5.572}, {2, 7.225}, {5, 11.668}, {10, 18.390}, {100, 121.63}})
        EXPECT_NEAR(events + expectation_above(events, events, 1.0), upper, 0.01 * upper) << events;
    // In other units.
    EXPECT_NEAR(0.05 + expectation_above(0.05, 0.05 * 0.01, 0.01), 0.11668, 0.001);
}

TEST(FewEvents, ManyLeaveOpenWhatTheirSpreadDoes) {
    EXPECT_NEAR(expectation_above(7.0, 1e-6, 1e-6 / 7.0) / 1.96e-3, 1.0, 0.001);
    EXPECT_EQ(expectation_above(7.0, 1.0, 0.0), 0.0);
}

// Numbers by Poisson, weights by an exponential distribution: the sums' upper ends are below what is expected in at most 2.5%,
// where those by the spread are in up to a third. 20 000 sums leave a standard error of 0.11%.
TEST(FewEvents, HoldWhereEventsDiffer) {
    std::mt19937_64 random(7);
    constexpr int sums = 20000;
    for (const double expected : {1.0, 3.0, 10.0}) {
        std::poisson_distribution<int> number(expected);
        std::exponential_distribution<double> weight(1.0);
        int above = 0, above_by_spread = 0;
        for (int i = 0; i < sums; ++i) {
            double sum = 0.0, squares = 0.0;
            for (int k = number(random); k > 0; --k) {
                const double w = weight(random);
                sum += w;
                squares += w * w;
            }
            above += expected > sum + expectation_above(sum, squares, 2.0);
            above_by_spread += expected > sum + 1.96 * std::sqrt(squares);
        }
        EXPECT_LE(above, (0.025 + 4.0 * 0.0011) * sums) << expected;
        EXPECT_GT(above_by_spread, 0.05 * sums) << expected;
    }
}

}  // namespace neumann::few_events_test
