// Pixels with different numbers of samples: which numbers are best, how paths are then numbered, and that pictures keep their means
// and their errors.
#include "operators/render/from_paths/allocation.h"
#include "core/reader/read_scene.h"
#include "operators/render/from_paths/corrected_sampler.h"
#include "operators/render/from_paths/picture_sampler.h"
#include "operators/render/report/replay.h"
#include "operators/statistics/student_t.h"
#include "tests/physics/picture_blocks.h"
#include "tests/physics/seed.h"

#include <gtest/gtest.h>

#include <array>
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

// As pattern(), with parts of corrected samples: a quarter of the mean number goes on in each pixel, or all where there are fewer.
std::shared_ptr<const Allocation> of_parts(std::size_t pixels, bool others_cast_rays) {
    CorrectedAllocation all;
    all.exponents = pattern(pixels)->exponents;
    all.first.directions = 8;
    all.first.points = 2;
    all.first.others_cast_rays = others_cast_rays;
    all.going_on = std::int8_t{-2};
    return std::make_shared<const CorrectedAllocation>(all);
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
double expect_same_blocks(const Scene& scene, SamplingSettings settings, const std::shared_ptr<const Allocation>& allocation,
                          std::uint64_t replicates, int fewest) {
    settings.replicate_size = 8;
    const Blocks even(scene, settings, 4, replicates);
    settings.allocation = allocation;
    settings.seed += 1;
    const Blocks uneven(scene, settings, 4, replicates);
    int within = 0, all = 0;
    for (std::size_t q = 0; q <= 4; ++q)
        for (std::size_t b = 0; b < even.blocks(); ++b) {
            const auto x = even.at(b, q, 1, replicates), y = uneven.at(b, q, 1, replicates);
            const double both = std::hypot(x.error, y.error);
            if (both == 0.0) continue;
            EXPECT_LE(std::abs(x.mean - y.mean), 4.5 * both) << q << ", block " << b;
            within += std::abs(x.mean - y.mean) <= student_t_quantile(0.95, 120.0) * both;
            ++all;
        }
    std::printf("%d of %d within\n", within, all);
    EXPECT_GE(all, fewest);
    return static_cast<double>(within) / all;
}
TEST(AllocationSlow, LeavesMeansAndErrorsRight) {
    const Scene scene = read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "24"}});
    const auto within = [&](const Method& method, std::uint64_t seed) {
        return expect_same_blocks(scene, settings_of(scene, method, 3, seed, 0.5), pattern(24 * 24), 64, 140);
    };
    for (const Method& method : std::vector<Method>{method::Walk{}, method::Bidirectional{}, method::Guided{}})
        EXPECT_GE(within(method, fixed_seed), 0.90);
    // Blocks of a bounce share points and are beyond their intervals together, so that one picture says little: four have 92.3 to
    // 95% over six seeds.
    double of_corrected = 0.0;
    for (std::uint64_t k = 0; k < 4; ++k) of_corrected += within(method::Corrected{}, fixed_seed + 2 * k) / 4.0;
    EXPECT_GE(of_corrected, 0.90);
}

// Samples that end at the first diffuse vertex, with and without a ray of their own: lights that touch surfaces, a sky, and diffuse
// surfaces behind mirrors, where what is found in mirrors and lamps belongs to all samples and what comes later to some. The blocks
// of a bounce share points and are beyond their intervals together, so that the part within is a mean over the scenes: over twelve
// seeds 91.7% at least.
TEST(AllocationSlow, LeavesMeansAndErrorsOfPartsRight) {
    const std::pair<const char*, int> blocks_of[] = {
        {"cornell-box", 140}, {"outdoor", 120}, {"facing-mirrors", 80}, {"door-ajar", 110}};
    double within = 0.0;
    for (const auto& [name, blocks] : blocks_of)
        for (const bool others_cast_rays : {false, true}) {
            SCOPED_TRACE(std::string(name) + (others_cast_rays ? ", with rays" : ""));
            const Scene scene = read_scene(SCENES "/" + std::string(name) + "/" + name + ".xml", {{"res", "24"}});
            within += expect_same_blocks(scene, settings_of(scene, method::Corrected{}, 3, fixed_seed, 0.5),
                                         of_parts(24 * 24, others_cast_rays), 64, blocks) /
                      8.0;
        }
    EXPECT_GE(within, 0.90);
}

// The mean over pixels of the squared standard error, as a part of the squared value and a hundredth of that of the picture, times
// the rays: of bounce q, or of the sum of bounces 0 to 4.
constexpr std::size_t the_sum = 5;
double noise(const Scene& scene, const SamplingSettings& settings, std::uint64_t replicates, std::size_t q) {
    const PictureSampler sampler(scene, settings);
    Tally tally(sampler.quantities());
    SeriesMoments moments(sampler.width(), sampler.height(), sampler.quantities());
    moments.add(*sampler.run(0, replicates, tally));
    const auto result = moments.result();
    const Estimate term = q == the_sum ? result.sum(4) : result.term(q);
    const double all = (q == the_sum ? result.mean_of_sum(4) : result.mean_of_term(q)).mean;
    double sum = 0.0;
    for (std::size_t pixel = 0; pixel < term.mean.pixels.size(); ++pixel) {
        const double value = mean_component(term.mean.pixels[pixel]), error = max_component(term.standard_error.pixels[pixel]);
        sum += error * error / (value * value + 0.01 * all * all);
    }
    return sum * static_cast<double>(std::accumulate(tally.rays.begin(), tally.rays.end(), std::uint64_t{0}));
}

// Of all errors together the mean is made least as long as no bounce, and not the sum, is worse than by walks in the same time.
// Equally many samples have 2.1 times the walk's noise in direct light, which gets so many of its own at edges that this holds, but
// for what pilots leave uncertain: over six seeds a mean of four renders was 0.88 to
// 1.09 of it, 1.0 on average.
TEST(AllocationSlow, GivesPartsTheirSamples) {
    const Scene scene = read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "48"}});
    constexpr double price_of_ray_of_walk = 0.7;  // beside one of the others (corrected_allocation.cpp)
    constexpr int renders = 4;
    std::array<double, the_sum + 1> beside_walk{};
    for (std::uint64_t k = 0; k < renders; ++k) {
        SamplingSettings parts = settings_of(scene, method::Corrected{}, 4, fixed_seed + k),
                         walk = settings_of(scene, method::Walk{}, 4, fixed_seed + k);
        parts.replicate_size = walk.replicate_size = 32;
        parts.allocation = parts.method->allocate(scene, parts, LeastError::of_all, {});
        for (std::size_t q = 1; q <= the_sum; ++q)
            beside_walk[q] += noise(scene, parts, 8, q) / (price_of_ray_of_walk * noise(scene, walk, 8, q)) / renders;
    }
    for (std::size_t q = 1; q <= the_sum; ++q) {
        std::printf("%s %zu: %.2f of the walk's\n", q == the_sum ? "sum to" : "bounce", std::min<std::size_t>(q, 4),
                    beside_walk[q]);
        EXPECT_LE(beside_walk[q], q == 1 ? 1.3 : 1.0);
    }
}

// A bounce that is asked for is known no worse than by numbers for all, but for what pilots leave uncertain, and direct light,
// which needs no ray but those for light, at least three times as well.
TEST(AllocationSlow, ServesTheBounceThatIsAskedFor) {
    const Scene scene = read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "48"}});
    SamplingSettings settings = settings_of(scene, method::Corrected{}, 4, fixed_seed);
    settings.replicate_size = 32;
    const auto numbers_for = [&](LeastError least) {
        SamplingSettings with = settings;
        with.allocation = settings.method->allocate(scene, settings, least, {});
        return with;
    };
    const SamplingSettings for_all = numbers_for(LeastError::of_all);
    for (int q = 1; q <= 4; ++q) {
        const auto k = static_cast<std::size_t>(q);
        const double ratio = noise(scene, numbers_for(LeastError::of_bounce(q)), 8, k) / noise(scene, for_all, 8, k);
        std::printf("bounce %d: %.2f\n", q, ratio);
        EXPECT_LE(ratio, q == 1 ? 1.0 / 3.0 : 1.25);
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
        settings.allocation = std::holds_alternative<method::Corrected>(method) ? of_parts(49, true) : pattern(49);
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
