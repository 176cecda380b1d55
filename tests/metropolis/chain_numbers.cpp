// What chains are made of: numbers that mutate, starts that are drawn in proportion, and figures of how chains mix, each beside a
// closed form.
#include "core/sampling/sampler.h"
#include "operators/paths/metropolis/chain_starts.h"
#include "operators/paths/metropolis/chain_statistics.h"
#include "operators/paths/metropolis/primary_numbers.h"
#include "operators/render/from_paths/metropolis_sampler.h"
#include "tests/physics/seed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

namespace neumann::chain_numbers_test {

using physics::fixed_seed;

// The step x → y has the density of y → x: with v = −ln(step/largest) / ln 16 uniform in [0, 1), to both sides alike, and across
// the ends.
TEST(PrimaryNumbers, MoveByStepsBetweenTheirBoundsToBothSidesAlike) {
    for (const double x : {0.0, 0.3, 0.999}) {
        EXPECT_NEAR(std::remainder(PrimaryNumbers::moved(x, 0.0) - x, 1.0), 1.0 / 1024.0, 1e-12);
        EXPECT_NEAR(std::remainder(PrimaryNumbers::moved(x, 0.5) - x, 1.0), -1.0 / 64.0, 1e-12);
        for (double u = 1e-4; u < 0.5; u += 0.01) {
            const double up = std::remainder(PrimaryNumbers::moved(x, u) - x, 1.0),
                         down = std::remainder(PrimaryNumbers::moved(x, 1.0 - u) - x, 1.0);
            EXPECT_NEAR(up, -down, 1e-12);
            EXPECT_NEAR(up, std::exp(std::log(1.0 / 16.0) * (1.0 - 2.0 * u)) / 64.0, 1e-12);
            EXPECT_GE(PrimaryNumbers::moved(x, u), 0.0);
            EXPECT_LT(PrimaryNumbers::moved(x, u), 1.0);
        }
    }
}

TEST(PrimaryNumbers, GoOnFromWhatWasAcceptedAlone) {
    Sampler source(fixed_seed, 3);
    source.start(0);
    PrimaryNumbers numbers;
    numbers.propose(PrimaryNumbers::Step::start, source);
    const Vec2 a = numbers.next2();
    const double b = numbers.next();
    Sampler again(fixed_seed, 3);
    again.start(0);
    EXPECT_EQ(a, again.next2());
    EXPECT_EQ(b, again.next());
    numbers.accept();
    for (int refused = 0; refused < 3; ++refused) {
        numbers.propose(PrimaryNumbers::Step::small, source);
        const Vec2 near_a = numbers.next2();
        EXPECT_NE(near_a, a);
        EXPECT_LE(std::abs(std::remainder(near_a.x - a.x, 1.0)), 1.0 / 64.0);
        EXPECT_LE(std::abs(std::remainder(near_a.y - a.y, 1.0)), 1.0 / 64.0);
        EXPECT_LE(std::abs(std::remainder(numbers.next() - b, 1.0)), 1.0 / 64.0);
    }
}

// A chain of states is drawn as often as its share says, to one start.
TEST(ChainStarts, AreDrawnInProportionToBrightness) {
    BrightnessSums sums(7, 3);
    const double of_group[7] = {0.0, 3.0, 0.0, 1.0, 0.5, 0.0, 5.5};
    for (std::uint32_t g = 0; g < 7; ++g) sums.of_group(g)[2] = of_group[g];
    EXPECT_EQ(sums.total(2), 10.0);
    for (const double u : {0.0, 0.4, 0.999999}) {
        const auto starts = choose_starts(sums, 100, std::vector{u, u, u});
        std::map<std::uint32_t, int> count;
        std::vector<bool> chains(100, false);
        for (const WantedStart& w : starts) {
            EXPECT_EQ(w.bounce, 2);
            EXPECT_GE(w.left, 0.0);
            EXPECT_LT(w.left, of_group[w.group]);
            EXPECT_FALSE(chains[w.chain]);
            chains[w.chain] = true;
            ++count[w.group];
        }
        EXPECT_EQ(starts.size(), 100u);  // bounce 1 has no light, and no chains
        for (std::uint32_t g = 0; g < 7; ++g) EXPECT_NEAR(count[g], 10.0 * of_group[g], 1.0) << g;
    }
}

TEST(ChainNumbers, AreNoMoreStatesThanThereMayBe) {
    for (const std::uint64_t states : {1u, 50u, 64u, 100u, 12345u, 262144u})
        for (const std::uint32_t length : {1u, 17u, 512u, 100000u}) {
            const ChainNumbers n = chain_numbers(states, length);
            EXPECT_LE(n.states(), states);
            EXPECT_GE(2 * n.states(), states);
            EXPECT_TRUE(n.chains % chains_at_once == 0 || n.length == 1);
            if (states >= chains_at_once * std::uint64_t{length}) {
                EXPECT_EQ(n.length, length);
            }
        }
    EXPECT_EQ(chain_numbers(262144, 512).chains, 512u);
}

// A chain on two places that stays with probability p has the autocorrelation (2p − 1)^k, and the time 2 Σ − 1 = p / (1 − p). The
// chains' means say it up to 1/length; 2000 chains give it to 3% (the relative error of a variance is √(2/2000)), tested at 4 σ.
TEST(ChainStatistics, HaveTheAutocorrelationTimeOfChainsThatAreKnown) {
    constexpr int length = 1000;
    for (const double p : {0.5, 0.9, 0.98}) {
        std::mt19937_64 random(fixed_seed);
        std::uniform_real_distribution<double> uniform;
        ChainStatistics all;
        for (int chain = 0; chain < 2000; ++chain) {
            ChainDiary diary;
            bool here = uniform(random) < 0.5;
            for (int k = 0; k < length; ++k) {
                diary.add_state({here ? 0.25 : 0.75, 0.5});
                if (uniform(random) >= p) here = !here;
            }
            diary.add_to(all);
        }
        const double time = p / (1.0 - p), ended = time * (1.0 - time / length);
        EXPECT_NEAR(all.autocorrelation_time(), ended, 0.13 * time) << p;
    }
}

TEST(ChainStatistics, SayThatChainsWhichDoNotMoveAreWorthAStateEach) {
    ChainStatistics all;
    for (int chain = 0; chain < 100; ++chain) {
        ChainDiary diary;
        for (int k = 0; k < 50; ++k) diary.add_state({chain / 100.0, 0.5});
        ChainStatistics one;
        diary.add_to(one);
        all.merge(one);
    }
    EXPECT_NEAR(all.autocorrelation_time(), 50.0, 1e-9);
    EXPECT_EQ(all.chains, 100u);
    EXPECT_EQ(all.states, 5000u);
    EXPECT_EQ(ChainStatistics().autocorrelation_time(), 0.0);
}

}  // namespace neumann::chain_numbers_test
