#include "operators/study/effort.h"

#include "operators/study/method_summary.h"

#include <gtest/gtest.h>

#include <set>

namespace neumann {
namespace {

TEST(Effort, LevelsNearestToTheBudgets) {
    const std::vector<double> measured{0.01, 0.02, 0.05};  // then 0.1, 0.2, …
    EXPECT_EQ(choose_levels(measured, std::vector{0.05, 0.1, 0.4, 0.9}), (std::vector{2, 3, 5, 6}));
    // Budgets that one level would fit best still grow; and one that is less than a single sample takes it.
    EXPECT_EQ(choose_levels(measured, std::vector{0.001, 0.0011, 0.0012}), (std::vector{0, 1, 2}));
    EXPECT_EQ(choose_levels(std::vector{1.0}, std::vector{5.7, 8.0}), (std::vector{3, 4}));
}

TEST(Effort, Levels) {
    EXPECT_EQ(sampling_effort(5).samples, 32u);
    const Effort field = field_effort(3);
    EXPECT_EQ(field.samples, 64u);
    EXPECT_EQ(field.patches, 2000u);
    EXPECT_EQ(field.directions, 128u);
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

}  // namespace
}  // namespace neumann
