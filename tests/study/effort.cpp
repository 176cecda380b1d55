#include "operators/experiments/study/effort.h"

#include "operators/experiments/study/method_summary.h"
#include "operators/render/from_paths/rendered_series.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <set>

namespace neumann::effort_test {

TEST(Effort, SamplesInWholeNets) {
    std::vector<std::uint64_t> all;
    for (double x = 1.0; x <= 1000.0; x += 0.25)
        if (const std::uint64_t n = whole_nets(x); all.empty() || n != all.back()) all.push_back(n);
    EXPECT_EQ(std::vector(all.begin(), all.begin() + 20),
              (std::vector<std::uint64_t>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 18, 20, 22, 24}));
    for (std::size_t i = 1; i < all.size(); ++i) {
        EXPECT_GT(all[i], all[i - 1]);
        if (all[i] <= 8) continue;
        EXPECT_LE(static_cast<double>(all[i]), 1.125 * static_cast<double>(all[i - 1]));
        // As render makes its replicates: at least four, of as many points as in powers of two, or half or a quarter of these.
        ASSERT_TRUE(replicates_of_nets(all[i])) << all[i];
        const std::uint64_t replicates = *replicates_of_nets(all[i]), size = all[i] / replicates;
        EXPECT_EQ(size * replicates, all[i]);
        EXPECT_TRUE(std::has_single_bit(size)) << all[i];
        EXPECT_GE(replicates, 4u);
        EXPECT_GE(size, std::min(std::bit_floor(all[i]) / 8, std::uint64_t{largest_replicate})) << all[i];
    }
    EXPECT_FALSE(replicates_of_nets(1000));
    EXPECT_EQ(whole_nets(0.2), 1u);
    EXPECT_EQ(whole_nets(0x1p30), std::uint64_t{1} << 30);
}

// Runs that take a + b n seconds, measured at n = 1, 2, 4, … up to a quarter of the budget: what is chosen takes the budget within
// a tenth, as long as eight samples fit it.
TEST(Effort, EqualTimesAreEqual) {
    for (const double overhead : {0.0, 0.003, 0.02})
        for (const double each : {1e-5, 0.0013, 0.017, 0.11}) {
            const auto seconds = [&](std::uint64_t n) { return overhead + each * static_cast<double>(n); };
            std::vector<double> budgets, measured;
            for (double budget = 1.0; budget < 40.0; budget *= 1.37) budgets.push_back(budget);
            do measured.push_back(seconds(std::uint64_t{1} << measured.size()));
            while (measured.back() < 0.25 * budgets.back());
            std::vector<double> levels;
            for (const double budget : budgets) levels.push_back(affordable_level(measured, 2.0, budget));
            const std::vector<Effort> efforts = sampling_efforts(levels);
            ASSERT_EQ(efforts.size(), budgets.size());
            for (std::size_t i = 0; i < budgets.size(); ++i) {
                EXPECT_NEAR(seconds(efforts[i].samples), budgets[i], 0.1 * budgets[i])
                    << overhead << " " << each << " " << budgets[i];
                if (i > 0) {
                    EXPECT_GT(efforts[i].samples, efforts[i - 1].samples);
                }
            }
        }
}

// Within, between and beyond the measured levels: the seconds of the level that fits them.
TEST(Effort, SecondsOfLevelsAreTheInverse) {
    const std::vector<double> measured{0.01, 0.02, 0.05};
    for (const double seconds : {0.01, 0.013, 0.02, 0.03, 0.05, 0.4})
        EXPECT_NEAR(seconds_of_level(measured, 2.0, affordable_level(measured, 2.0, seconds)), seconds, 1e-12) << seconds;
    EXPECT_NEAR(seconds_of_level(measured, 2.0, 4.0), 0.2, 1e-12);
}

TEST(Effort, LevelsOfTimes) {
    const std::vector<double> measured{0.01, 0.02, 0.05};
    EXPECT_NEAR(affordable_level(measured, 2.0, 0.02), 1.0, 1e-12);
    EXPECT_NEAR(affordable_level(measured, 2.0, std::sqrt(0.02 * 0.05)), 1.5, 1e-12);
    EXPECT_NEAR(affordable_level(measured, 2.0, 0.4), 5.0, 1e-12);
    EXPECT_NEAR(affordable_level(measured, 3.0, 0.45), 4.0, 1e-12);
    EXPECT_EQ(affordable_level(measured, 2.0, 0.001), 0.0);
    EXPECT_EQ(affordable_level(measured, 2.0, 1e300), largest_effort);
}

// Time t = t_k p^a between two levels, where the number of patches is p 250·2^k: one correction brings it there where a = 1, and
// never beyond the next level.
TEST(Effort, FieldsAreCorrected) {
    for (const double level : {3.0, 3.4, 3.9})
        for (const double budget : {1.0, 1.3, 1.9}) {
            const auto seconds = [](double x) { return std::exp2(x - 3.0); };
            EXPECT_NEAR(seconds(corrected_level(level, seconds(level), budget)), budget, 1e-12);
        }
    EXPECT_EQ(std::floor(corrected_level(3.4, 0.1, 1.0)), 3.0);
    EXPECT_EQ(corrected_level(3.4, 10.0, 1.0), 3.0);
    EXPECT_EQ(*field_efforts(std::vector{corrected_level(3.4, 0.1, 1.0)}, false)[0].directions, 128u);
    EXPECT_NEAR(field_growth(std::vector{1.0, 2.0, 8.0, 16.0}), std::sqrt(8.0), 1e-12);
    EXPECT_EQ(field_growth(std::vector{1.0, 9.0}), 2.0);
}

TEST(Effort, EqualIsWithinATenth) {
    EXPECT_FALSE(misses(2.15, 2.0));
    EXPECT_FALSE(misses(1.85, 2.0));
    EXPECT_TRUE(misses(2.25, 2.0));
    EXPECT_TRUE(misses(1.75, 2.0));
    EXPECT_TRUE(misses(5.62, 2.0));
}

// Budgets that one effort would fit best still grow, and one that is less than a single sample takes it.
TEST(Effort, EffortsGrow) {
    const std::vector<double> none{0.0, 0.0, 0.1}, some{5.0, 5.01, 5.02};
    const auto samples = [](const std::vector<Effort>& efforts) {
        std::vector<std::uint64_t> all;
        for (const Effort& e : efforts) all.push_back(e.samples);
        return all;
    };
    EXPECT_EQ(samples(sampling_efforts(none)), (std::vector<std::uint64_t>{1, 2, 3}));
    EXPECT_EQ(samples(sampling_efforts(some)), (std::vector<std::uint64_t>{32, 36, 40}));
    EXPECT_EQ(samples(field_efforts(some, true)), (std::vector<std::uint64_t>{256, 512, 1024}));
    const std::vector<Effort> fields = field_efforts(some, false);
    for (std::size_t i = 1; i < fields.size(); ++i)
        EXPECT_GE(*fields[i].patches, *fields[i - 1].patches + *fields[i - 1].patches / 20);
}

TEST(Effort, Levels) {
    EXPECT_EQ(sampling_effort(5).samples, 32u);
    const Effort field = field_effort(3);
    EXPECT_EQ(field.samples, 64u);
    EXPECT_EQ(field.patches, 2000u);
    EXPECT_EQ(field.directions, 128u);
    const Effort between = field_effort(3.5);
    EXPECT_EQ(between.samples, 64u);
    EXPECT_EQ(between.patches, 2828u);
    EXPECT_EQ(between.directions, 128u);
    EXPECT_EQ(field_effort_of_samples(64).patches, 2000u);
    EXPECT_EQ(field_effort_of_samples(1).patches, 250u);
    EXPECT_EQ(field_effort_of_samples(1).samples, 1u);
}

TEST(StudySeed, EveryRunHasItsOwn) {
    std::set<std::uint64_t> seeds{study_seed(0, reference_method, 0, 0)};
    for (std::uint64_t seed = 0; seed < 4; ++seed)
        for (std::uint64_t method = 0; method < 8; ++method)
            for (std::uint64_t budget = 0; budget < 8; ++budget)
                for (std::uint64_t repeat = 0; repeat < 64; ++repeat) seeds.insert(study_seed(seed, method, budget, repeat));
    EXPECT_EQ(seeds.size(), 1u + 4 * 8 * 8 * 64);
    EXPECT_LT(*seeds.rbegin(), std::uint64_t{1} << 48);
}

TEST(MethodSummary, Medians) {
    EXPECT_EQ(median_with_error({3.0, 1.0, 2.0}).value, 2.0);
    EXPECT_EQ(median_with_error({4.0, 1.0, 2.0, 3.0}).value, 2.5);
    // Distances 2, 1, 0, 1, 97 of 1, 2, 3, 4, 100: their median is 1.
    EXPECT_NEAR(median_with_error({1.0, 2.0, 3.0, 4.0, 100.0}).standard_error, 1.2533 * 1.4826 / std::sqrt(5.0), 1e-12);
}

ErrorStatistics errors(double mse, double bias_squared) {
    ErrorStatistics e;
    e.mse.assign(16, mse);
    e.mean_mse = {mse, 0.01 * mse};
    e.variance = {mse - bias_squared, 0.01 * mse};
    e.bias_squared = {bias_squared, 0.01 * mse};
    return e;
}

// Three methods: the second is twice as fast as the first, the third has a tenth of the variance but a bias.
TEST(MethodSummary, RankedByErrorAndTime) {
    const RepeatCosts slow{{0.0, 0.0}, {1.0, 1.0}}, slower{{0.0, 0.0}, {4.0, 4.0}}, fast{{0.1, 0.1}, {0.5, 0.5}},
        faster{{0.1, 0.1}, {2.0, 2.0}};
    const ErrorStatistics few = errors(0.04, 0.0), many = errors(0.01, 0.0), biased = errors(0.05, 0.046);
    const std::vector<StudiedPoint> a{{4, slow, few}, {16, slower, many}}, b{{4, fast, few}, {16, faster, many}},
        c{{4, slow, biased}, {16, slower, biased}}, d{{4, fast, few}, {16, faster, many, true}};
    std::vector<PictureSummary> all{summarise(a, 1.0), summarise(b, 1.0), summarise(c, 1.0), summarise(d, 1.0)};
    std::vector<PictureSummary*> order{&all[0], &all[1], &all[2], &all[3]};
    rank(order);
    EXPECT_EQ(all[1].rank, 1);
    EXPECT_EQ(all[0].rank, 2);
    EXPECT_EQ(all[2].rank, 3);
    EXPECT_EQ(all[3].rank, 4);  // of infinite variance, whatever its error
    EXPECT_NEAR(all[0].slope->slope, -0.5, 1e-12);
    EXPECT_NEAR(all[0].slope_by_samples->slope, -0.5, 1e-12);
    EXPECT_NEAR(all[0].points[1].efficiency, 1.0 / (0.01 * 4.0), 1e-9);
    EXPECT_NEAR(all[2].points[1].merit, 1.0 / (0.05 * 4.0), 1e-9);
    EXPECT_NEAR(all[1].points[0].sampling_seconds.value, 0.4, 1e-12);
    EXPECT_FALSE(all[0].points[0].biased);
    EXPECT_TRUE(all[2].points[0].biased);
    EXPECT_NEAR(error_reached_by_all(all), std::sqrt(0.05), 1e-12);
    find_seconds_to_error(all[0], 0.1, a);
    EXPECT_NEAR(all[0].seconds_to_error->work, 4.0, 1e-12);
}

}  // namespace neumann::effort_test
