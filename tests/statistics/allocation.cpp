// Pixels with different numbers of samples: which numbers are best, how paths are then numbered, and that pictures keep their means
// and their errors.
#include "operators/render/from_paths/allocation.h"
#include "core/reader/read_scene.h"
#include "operators/render/from_paths/picture_sampler.h"
#include "operators/render/report/replay.h"
#include "operators/statistics/student_t.h"
#include "tests/physics/picture_blocks.h"
#include "tests/physics/seed.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <random>

namespace neumann::allocation_test {

using physics::Blocks;
using physics::fixed_seed;
using physics::settings_of;

double error(const BlockCosts& costs, std::size_t k, std::span<const double> numbers) {
    double sum = 0.0;
    for (std::size_t b = 0; b < costs.blocks; ++b) sum += costs.variance(k)[b] / numbers[b];
    return sum;
}

// One error: s ∝ √(V/c), e² = (Σ √(V c))² / Σ c (Cauchy and Schwarz).
TEST(Allocation, OfOneErrorHasTheClosedForm) {
    const BlockCosts costs{4, {1.0, 4.0, 0.25, 9.0}, {1.0, 2.0, 5.0, 0.5}};
    const auto numbers = best_numbers(costs, LeastError::of_sum);
    double root = 0.0, cost = 0.0, spent = 0.0;
    for (std::size_t b = 0; b < 4; ++b) {
        root += std::sqrt(costs.variances[b] * costs.costs[b]);
        cost += costs.costs[b];
        spent += costs.costs[b] * numbers[b];
        EXPECT_NEAR(numbers[b] / numbers[0], std::sqrt(costs.variances[b] / costs.costs[b]), 1e-12);
    }
    EXPECT_NEAR(spent, cost, 1e-12);
    EXPECT_NEAR(error(costs, 0, numbers), root * root / cost, 1e-12);
}

// Several errors: no other distribution of the same cost has a smaller largest error, or largest of a bounce times the mean of all,
// by more than the search leaves.
TEST(Allocation, OfSeveralErrorsMakesLeastWhatIsAskedFor) {
    std::mt19937_64 random(fixed_seed);
    std::uniform_real_distribution<double> uniform(0.05, 1.0);
    for (int trial = 0; trial < 20; ++trial) {
        BlockCosts costs{5, {}, {}};
        for (int i = 0; i < 15; ++i) costs.variances.push_back(std::pow(uniform(random), 4.0));
        for (int i = 0; i < 5; ++i) costs.costs.push_back(uniform(random));
        for (const LeastError least_error : {LeastError::of_bounces, LeastError::of_all}) {
            const auto size = [&](const std::vector<double>& numbers) {
                const double a = error(costs, 0, numbers), b = error(costs, 1, numbers), c = error(costs, 2, numbers);
                return least_error == LeastError::of_bounces ? std::max({a, b, c}) : std::max(a, b) * std::cbrt(a * b * c);
            };
            const auto numbers = best_numbers(costs, least_error);
            const double least = size(numbers);
            const double budget = std::accumulate(costs.costs.begin(), costs.costs.end(), 0.0);
            for (int other = 0; other < 2000; ++other) {
                std::vector<double> changed = numbers;
                for (double& s : changed) s *= std::exp(0.2 * (uniform(random) - 0.5));
                double cost = 0.0;
                for (std::size_t b = 0; b < 5; ++b) cost += costs.costs[b] * changed[b];
                for (double& s : changed) s *= budget / cost;
                EXPECT_GE(size(changed), 0.99 * least);
            }
        }
    }
}

TEST(Allocation, ByPowersCostsNoMoreThanOneSampleEach) {
    std::mt19937_64 random(fixed_seed);
    std::lognormal_distribution<double> numbers_of(0.0, 2.0), costs_of(0.0, 0.5);
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<double> numbers(200), costs(200);
        for (double& s : numbers) s = numbers_of(random);
        for (double& c : costs) c = costs_of(random);
        double cost = 0.0;
        const double budget = std::accumulate(costs.begin(), costs.end(), 0.0);
        const auto powers = as_powers(numbers, costs, budget, 4);
        for (std::size_t b = 0; b < 200; ++b) {
            EXPECT_LE(std::abs(powers[b]), 4);
            cost += costs[b] * std::exp2(powers[b]);
        }
        EXPECT_LE(cost, budget);
        EXPECT_GE(cost, 0.9 * budget);
    }
    EXPECT_EQ(as_powers({1.0, 1.0, 1.0}, std::vector{1.0, 1.0, 1.0}, 3.0, 4), (std::vector<std::int8_t>{0, 0, 0}));
}

std::shared_ptr<const Allocation> pattern(std::size_t pixels) {
    Allocation all;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) all.exponents.push_back(static_cast<std::int8_t>(pixel / 3 % 6) - 3);
    return std::make_shared<const Allocation>(all);
}

// As pattern(), but every seventh pixel, the first and the last have no samples.
std::shared_ptr<const Allocation> with_holes(std::size_t pixels) {
    Allocation all = *pattern(pixels);
    for (std::size_t pixel = 0; pixel < pixels; pixel += 7) all.exponents[pixel] = Allocation::none;
    all.exponents.back() = Allocation::none;
    return std::make_shared<const Allocation>(all);
}

TEST(SampleLayout, GivesEachPathANameAndFindsItAgain) {
    for (const auto& allocation : {std::shared_ptr<const Allocation>(), pattern(101), with_holes(101)})
        for (const std::uint32_t size : {1u, 4u, 32u}) {
            const SampleLayout layout(101, size, allocation);
            std::uint32_t path = 0;
            for (std::uint32_t g = 0; g < layout.groups(); ++g) {
                const PixelGroup group = layout.group(g);
                EXPECT_EQ(layout.first_path(group.begin), path);
                EXPECT_TRUE(group.paths() <= 64 || group.end == group.begin + 1);
                for (std::uint32_t pixel = group.begin; pixel < group.end; ++pixel) {
                    EXPECT_EQ(layout.size(pixel), group.size);
                    EXPECT_EQ(layout.group_of(pixel), g);
                    for (std::uint32_t i = 0; i < group.size; ++i, ++path) {
                        const SampleName name = layout.name(7, path);
                        EXPECT_EQ(name, (SampleName{pixel, 7 * group.size + i}));
                        const PlaceInGroup place = layout.place(name);
                        EXPECT_EQ(place.replicate, 7u);
                        EXPECT_EQ(place.first + place.path, path);
                        EXPECT_EQ(place.first, layout.first_path(group.begin));
                    }
                }
            }
            EXPECT_EQ(path, layout.paths());
        }
}

// Whatever the numbers of samples are, means stay and errors are those of the samples that are there: the same blocks with and
// without, |z| ≤ 4.5 in about 350 comparisons (false alarm 0.3%), and 92% … 98% within their 95% intervals.
TEST(AllocationSlow, LeavesMeansAndErrorsRight) {
    const Scene scene = read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "24"}});
    for (const Method& method :
         std::vector<Method>{method::Walk{}, method::Bidirectional{}, method::Guided{}, method::Corrected{}}) {
        SamplingSettings settings = settings_of(scene, method, 3, fixed_seed, 0.5);
        settings.replicate_size = 8;
        const Blocks even(scene, settings, 4, 64);
        settings.allocation = pattern(24 * 24);
        settings.seed = fixed_seed + 1;
        const Blocks uneven(scene, settings, 4, 64);
        int within = 0, all = 0;
        for (std::size_t q = 0; q <= 4; ++q)
            for (std::size_t b = 0; b < even.blocks(); ++b) {
                const auto x = even.at(b, q, 1, 64), y = uneven.at(b, q, 1, 64);
                const double both = std::hypot(x.error, y.error);
                if (both == 0.0) continue;
                EXPECT_LE(std::abs(x.mean - y.mean), 4.5 * both) << q << ", block " << b;
                within += std::abs(x.mean - y.mean) <= student_t_quantile(0.95, 120.0) * both;
                ++all;
            }
        EXPECT_GE(all, 140);
        EXPECT_GE(within, 0.90 * all) << within << " of " << all;
    }
}

// All that was cast is counted: a pilot's rays are those of the pixels' paths and of the points that they share, as in a picture.
TEST(Allocation, CountsTheRaysOfWhatPixelsShare) {
    const Scene scene = read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "16"}});
    const SamplingSettings settings = physics::settings_of(scene, method::Corrected{{}, 60, 16}, 3, 1);
    const PictureSampler sampler(scene, settings);
    std::atomic<std::uint64_t> own = 0;
    const std::optional<std::uint64_t> shared =
        sampler.path_sampler().own_samples(0,
                                           [&](const PixelGroup&, std::span<const Rgb>, std::span<const std::uint64_t> rays) {
                                               own += std::accumulate(rays.begin(), rays.end(), std::uint64_t{0});
                                           },
                                           {});
    ASSERT_TRUE(shared);
    Tally tally(sampler.quantities());
    (void)sampler.run(0, 1, tally);
    EXPECT_EQ(own + *shared, std::accumulate(tally.rays.begin(), tally.rays.end(), std::uint64_t{0}));
    EXPECT_GT(*shared, 10000u);
    // The pilot takes a quarter of the samples, and so not fewer rays than its points alone.
    EXPECT_GT(allocate(scene, settings, LeastError::of_sum)->rays, *shared);
}

TEST(Allocation, ReplaysItsSamplesToTheBit) {
    const Scene scene = read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "7"}});
    for (const Method& method :
         std::vector<Method>{method::Walk{}, method::Bidirectional{}, method::Guided{}, method::Corrected{}}) {
        SamplingSettings settings = settings_of(scene, method, 2, 5);
        settings.replicate_size = 8;
        settings.allocation = pattern(49);
        const PictureSampler sampler(scene, settings);
        Tally tally(sampler.quantities());
        (void)sampler.run(3, 1, tally).value();
        int compared = 0;
        for (std::size_t q = 1; q <= 2; ++q)
            for (const LargestSamples::Sample& s : tally.largest[q].standing_out()) {
                if (s.place.name.pixel != s.place.pixel || ++compared > 100) continue;
                EXPECT_EQ(max_component(glm::abs(replay(sampler, s.place.name).terms[q])), s.value);
            }
        EXPECT_GT(compared, 20);
    }
}

}  // namespace neumann::allocation_test
