// The best mixture of methods beside closed forms, and beside all others nearby.
#include "operators/render/from_paths/best_mixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace neumann::best_mixture_test {

double cost_of(const MixtureCosts& costs, const std::vector<double>& numbers) {
    return std::inner_product(numbers.begin(), numbers.end(), costs.costs.begin(), 0.0);
}

// One method and one bounce: s_b ∝ √(V_b / c_b).
TEST(BestMixture, OfOneMethodGivesBlocksWhatTheyNeed) {
    const MixtureCosts costs{1, 1, 3, {1.0, 4.0, 9.0}, {1.0, 1.0, 4.0}, {1.0}, 6.0};
    const std::vector<double> numbers = best_mixture(costs, LeastError::of_all);
    const double scale = 6.0 / (1.0 + 2.0 + 4.0 * 1.5);
    EXPECT_NEAR(numbers[0], scale, 1e-3);
    EXPECT_NEAR(numbers[1], 2.0 * scale, 1e-3);
    EXPECT_NEAR(numbers[2], 1.5 * scale, 1e-3);
    EXPECT_NEAR(cost_of(costs, numbers), 6.0, 1e-9);
}

// Where a method is better for its cost in all bounces, it gets all samples; where both cost V c alike, both have equal precision
// for their cost, and the weights are as the costs spent.
TEST(BestMixture, TakesTheBetterMethodInEachBlock) {
    const MixtureCosts costs{2, 1, 2, {1.0, 8.0, 6.0, 1.0}, {1.0, 1.0, 1.0, 1.0}, {1.0}, 2.0};
    const std::vector<double> numbers = best_mixture(costs, LeastError::of_all);
    EXPECT_NEAR(numbers[0], 1.0, 1e-3);
    EXPECT_NEAR(numbers[1], 0.0, 1e-3);
    EXPECT_NEAR(numbers[2], 0.0, 1e-3);
    EXPECT_NEAR(numbers[3], 1.0, 1e-3);
    const std::vector<double> weights = weights_of(costs, {1.0, 1.0, 3.0, 2.0});
    // Σ_m s/V = 1 + 3/6 in block 0, 1/8 + 2 in block 1.
    EXPECT_DOUBLE_EQ(weights[0], 1.0 / 1.5);
    EXPECT_DOUBLE_EQ(weights[1], 0.125 / 2.125);
    EXPECT_DOUBLE_EQ(weights[2], 0.5 / 1.5);
    EXPECT_DOUBLE_EQ(weights[3], 2.0 / 2.125);
    const std::vector<double> errors = errors_of(costs, {1.0, 1.0, 3.0, 2.0});
    EXPECT_DOUBLE_EQ(errors[0], 1.0 / 1.5 + 1.0 / 2.125);
    const std::vector<double> shares = shares_of(costs, {1.0, 1.0, 3.0, 2.0});
    EXPECT_DOUBLE_EQ(shares[0], 2.0 / 7.0);
}

// Two methods, each good for one of two bounces of equal size, one block: by the symmetry half of the cost each.
TEST(BestMixture, SharesABlockWhereEachMethodHasItsBounce) {
    const MixtureCosts costs{2, 2, 1, {1.0, 100.0, 100.0, 1.0}, {1.0, 1.0}, {0.5, 0.5}, 1.0};
    const std::vector<double> numbers = best_mixture(costs, LeastError::of_all);
    EXPECT_NEAR(numbers[0], 0.5, 1e-3);
    EXPECT_NEAR(numbers[1], 0.5, 1e-3);
}

// One method, one block for each bounce and nothing between them: the largest error is least where all are alike, s_b ∝ V_b / c_b
// with V_b c_b equal for each, and that of the sum where s_b ∝ √(r_b V_b / c_b).
TEST(BestMixture, MakesTheErrorLeastThatIsAskedFor) {
    constexpr double none = 1e-12;
    const MixtureCosts costs{1, 2, 2, {1.0, none, none, 4.0}, {1.0, 1.0}, {0.9, 0.1}, 1.0};
    const std::vector<double> largest = best_mixture(costs, LeastError::of_bounces);
    EXPECT_NEAR(largest[0], 0.2, 1e-3);
    EXPECT_NEAR(largest[1], 0.8, 1e-3);
    EXPECT_NEAR(least_of(costs, largest, LeastError::of_bounces), 5.0, 5e-3);
    const std::vector<double> sum = best_mixture(costs, LeastError::of_sum);
    const double a = std::sqrt(0.9), b = std::sqrt(0.4);
    EXPECT_NEAR(sum[0], a / (a + b), 1e-3);
    EXPECT_NEAR(least_of(costs, sum, LeastError::of_sum), (a + b) * (a + b), 1e-3);
    const std::vector<double> half{0.5, 0.5};
    EXPECT_NEAR(least_of(costs, half, LeastError::of_bounces), 8.0, 1e-9);
    EXPECT_NEAR(least_of(costs, half, LeastError::of_sum), 0.9 * 2.0 + 0.1 * 8.0, 1e-9);
    EXPECT_NEAR(least_of(costs, half, LeastError::of_all), std::cbrt(2.0 * 8.0 * 2.6), 1e-9);
}

// The second method has as many samples in both blocks, and the first what it needs. With one bounce, of a total precision
// P_b = s_b / V_b + s / U_b, Σ 1/P_b at Σ c_b s_b + C s given is least where 1/(V_b P_b²) = λ c_b where s_b > 0, and
// Σ 1/(U_b P_b²) = λ C. Here V = (4, 4), c = (1, 1), U = (1, 16), C = 2: block 2 has P = 1/√(4λ), so that 1/(16 P²) = λ/4, and
// block 1, whose s_1 = 0, has 1/P² = λ (2 − 1/4), and s = P_1.
TEST(BestMixture, GivesAMethodAsManySamplesInAllBlocksWhereItMust) {
    const MixtureCosts costs{2, 1, 2, {4.0, 4.0, 1.0, 16.0}, {1.0, 1.0, 1.0, 1.0}, {1.0}, 4.0, {false, true}};
    const std::vector<double> numbers = best_mixture(costs, LeastError::of_sum);
    EXPECT_EQ(numbers[2], numbers[3]);
    EXPECT_NEAR(cost_of(costs, numbers), 4.0, 1e-9);
    EXPECT_NEAR(numbers[0], 0.0, 1e-3);
    const double s = numbers[2], second = numbers[1] / 4.0 + s / 16.0;
    EXPECT_NEAR(s / second, std::sqrt(4.0 / 1.75), 2e-3);
}

// The problem is convex, so a place that no nearby one betters is the best: 200 random problems, 50 steps away from each.
TEST(BestMixture, IsBetterThanAllNearby) {
    std::mt19937_64 random(7);
    std::lognormal_distribution<double> variance(0.0, 2.0), cost(0.0, 0.5), step(0.0, 0.1);
    for (int problem = 0; problem < 200; ++problem) {
        MixtureCosts costs{3, 4, 5, std::vector<double>(60), std::vector<double>(15), {0.6, 0.2, 0.15, 0.05}, 5.0};
        for (double& v : costs.variances) v = variance(random);
        for (double& c : costs.costs) c = cost(random);
        for (const LeastError least : {LeastError::of_bounces, LeastError::of_sum, LeastError::of_all}) {
            const std::vector<double> best = best_mixture(costs, least);
            EXPECT_NEAR(cost_of(costs, best), 5.0, 1e-9);
            for (int k = 0; k < 50; ++k) {
                std::vector<double> other = best;
                for (double& s : other) s *= step(random);
                const double scale = 5.0 / cost_of(costs, other);
                for (double& s : other) s *= scale;
                EXPECT_GE(least_of(costs, other, least), (1.0 - 1e-3) * least_of(costs, best, least)) << problem;
            }
            const std::vector<double> weights = weights_of(costs, best);
            for (std::size_t i = 0; i < 20; ++i) EXPECT_NEAR(weights[i] + weights[20 + i] + weights[40 + i], 1.0, 1e-12);
        }
    }
}

}  // namespace neumann::best_mixture_test
