// The random numbers: uniform, independent of each other across pixels, replicates, dimensions and seeds; and what Sobol's points
// promise within a replicate.
//
// Hypotheses are tested by p-values against 1e-5, two-sided where too good a fit is suspicious as well. There are about 250 of them
// in this file: for a new seed one false alarm in 200 runs.
#include "core/sampling/sampler.h"

#include <gtest/gtest.h>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <vector>

namespace neumann::sampler_numbers_test {

constexpr double rejected = 1e-5;
constexpr std::uint64_t seed = 1;

// Two-sided p-value of counts that should all be alike.
double chi_squared_p(const std::vector<double>& counts) {
    double total = 0.0, sum = 0.0;
    for (const double n : counts) total += n;
    const double expected = total / static_cast<double>(counts.size());
    for (const double n : counts) sum += (n - expected) * (n - expected) / expected;
    const boost::math::chi_squared distribution(static_cast<double>(counts.size() - 1));
    return 2.0 * std::min(cdf(distribution, sum), cdf(complement(distribution, sum)));
}

// Of pairs that should be uniform in the square and uncorrelated.
class Pairs {
public:
    void add(double x, double y) {
        ++counts_[static_cast<std::size_t>(x * bins) * bins + static_cast<std::size_t>(y * bins)];
        sum_ += (x - 0.5) * (y - 0.5);
        ++n_;
    }
    double uniform_p() const { return chi_squared_p(counts_); }
    double correlation_p() const {
        const double z = 12.0 * sum_ / std::sqrt(static_cast<double>(n_));  // the variance of (x − ½)(y − ½) is 1/144
        return 2.0 * cdf(complement(boost::math::normal(), std::abs(z)));
    }
    void expect_independent(const std::string& what) const {
        EXPECT_GT(uniform_p(), rejected) << what;
        EXPECT_GT(correlation_p(), rejected) << what;
    }

private:
    static constexpr std::size_t bins = 16;
    std::vector<double> counts_ = std::vector<double>(bins * bins);
    double sum_ = 0.0;
    std::uint64_t n_ = 0;
};

// The samplers behind one face: number `dimension` of a sample.
struct Independent {
    static constexpr std::uint32_t replicate_size = 1;
    static Sampler make(std::uint64_t s, std::uint32_t pixel) { return {s, pixel}; }
};
struct Sobol {
    static constexpr std::uint32_t replicate_size = 8;
    static Sampler make(std::uint64_t s, std::uint32_t pixel) {
        static const SobolPoints points(replicate_size);
        return {points, s, pixel};
    }
};

template <class Kind>
std::vector<double> numbers(std::uint64_t s, std::uint32_t pixel, std::uint64_t sample, std::size_t count) {
    auto sampler = Kind::make(s, pixel);
    sampler.start(sample);
    std::vector<double> u(count);
    for (double& x : u) x = sampler.next();
    return u;
}

template <class Kind>
class SamplerNumbers : public testing::Test {};
using Kinds = testing::Types<Independent, Sobol>;
TYPED_TEST_SUITE(SamplerNumbers, Kinds);

// Dimensions around those where tables begin and end; of Sobol's replicates one point each, which is uniform by itself, at every
// index.
TYPED_TEST(SamplerNumbers, NumbersAreUniformInEveryDimension) {
    constexpr std::size_t bins = 256;
    std::vector<std::vector<double>> counts(136, std::vector<double>(bins));
    constexpr std::uint64_t size = TypeParam::replicate_size;
    for (std::uint32_t pixel = 0; pixel < 256; ++pixel)
        for (std::uint64_t replicate = 0; replicate < 256; ++replicate) {
            const auto u = numbers<TypeParam>(seed, pixel, replicate * size + replicate % size, counts.size());
            for (std::size_t d = 0; d < u.size(); ++d) {
                ASSERT_GE(u[d], 0.0);
                ASSERT_LT(u[d], 1.0);
                ++counts[d][static_cast<std::size_t>(u[d] * bins)];
            }
        }
    double smallest = 1.0;
    for (std::size_t d = 0; d < counts.size(); ++d) {
        const double p = chi_squared_p(counts[d]);
        EXPECT_GT(p, rejected) << "dimension " << d;
        smallest = std::min(smallest, p);
    }
    std::printf("smallest p-value of %zu: %.2g\n", counts.size(), smallest);
}

TYPED_TEST(SamplerNumbers, NeighboursAreIndependent) {
    constexpr std::uint64_t size = TypeParam::replicate_size;
    const std::size_t dimensions[] = {0, 1, 2, 5, 127, 128};
    for (const std::size_t d : dimensions) {
        Pairs pixels, rows, replicates, next_dimension, fourth_dimension, seeds, block;
        for (std::uint32_t pixel = 0; pixel < 256; ++pixel)
            for (std::uint64_t replicate = 0; replicate < 256; ++replicate) {
                const std::uint64_t i = replicate * size + replicate % size;
                const auto at = [&](std::uint64_t s, std::uint32_t p, std::uint64_t sample, std::size_t dimension) {
                    return numbers<TypeParam>(s, p, sample, dimension + 1)[dimension];
                };
                const auto u = numbers<TypeParam>(seed, pixel, i, d + 5);
                next_dimension.add(u[d], u[d + 1]);
                fourth_dimension.add(u[d], u[d + 4]);
                if (replicate % 4) continue;
                pixels.add(u[d], at(seed, pixel + 1, i, d));
                rows.add(u[d], at(seed, pixel + 256, i, d));
                replicates.add(u[d], at(seed, pixel, i + size, d));
                block.add(u[d], at(seed, pixel, i + 64 * size, d));
                seeds.add(u[d], at(seed + 1, pixel, i, d));
            }
        const std::string where = " from dimension " + std::to_string(d);
        next_dimension.expect_independent("next dimension" + where);
        fourth_dimension.expect_independent("fourth dimension" + where);
        pixels.expect_independent("next pixel" + where);
        rows.expect_independent("pixel of the next row" + where);
        replicates.expect_independent("next replicate" + where);
        block.expect_independent("replicate of another block" + where);
        seeds.expect_independent("next seed" + where);
    }
}

// Every sample has the numbers it has, whichever others were asked for.
TYPED_TEST(SamplerNumbers, NumbersDependOnTheirPlaceOnly) {
    auto sampler = TypeParam::make(7, 3);
    for (const std::uint64_t sample : {0, 1, 8, 3, 1000, 1, 999, 0})
        for (const std::size_t count : {1u, 130u, 6u}) {
            sampler.start(sample);
            const auto fresh = numbers<TypeParam>(7, 3, sample, count);
            for (const double u : fresh) ASSERT_EQ(sampler.next(), u);
        }
    std::set<double> seen;
    for (std::uint64_t s = 0; s < 4; ++s)
        for (std::uint32_t pixel = 0; pixel < 16; ++pixel)
            for (std::uint64_t sample = 0; sample < 64; ++sample)
                for (const double u : numbers<TypeParam>(s, pixel, sample, 8)) seen.insert(u);
    EXPECT_GE(seen.size(), 4u * 16 * 64 * 8 - 10);  // 32,768 numbers of 32 bits: 0.1 pairs alike
}

// Copies of a pixel's sampler share what they know, wherever each of them is: in other replicates, far apart in a large net, some
// dimensions ahead.
TEST(SobolNumbers, CopiesDoNotDisturbEachOther) {
    const SobolPoints points(256);
    const Sampler pixel(points, 7, 3);
    std::vector<Sampler> together, alone;
    for (const std::uint64_t sample : {0, 1, 63, 64, 200, 255, 256, 320, 5000}) {
        together.push_back(pixel);
        alone.emplace_back(points, 7, 3);
        together.back().start(sample);
        alone.back().start(sample);
    }
    for (int step = 0; step < 140; ++step)
        for (std::size_t i = 0; i < together.size(); ++i)
            for (std::size_t n = 0; n < i % 3 + 1; ++n) ASSERT_EQ(together[i].next(), alone[i].next()) << step << ' ' << i;
}

// The mean of a replicate of 8 samples is right on average. 2 × 40,000 replicates.
template <class Kind>
struct ReplicateMeans {
    double mean = 0.0, variance = 0.0, error = 0.0;
    explicit ReplicateMeans(const std::function<double(double, double, double)>& f, std::size_t dimension) {
        constexpr int n = 40'000;
        double sum = 0.0, squares = 0.0;
        for (std::uint32_t pixel = 0; pixel < 200; ++pixel)
            for (std::uint64_t replicate = 0; replicate < 200; ++replicate) {
                double x = 0.0;
                for (std::uint64_t i = 8 * replicate; i < 8 * (replicate + 1); ++i) {
                    const auto u = numbers<Kind>(seed, pixel, i, dimension + 3);
                    x += f(u[dimension], u[dimension + 1], u[dimension + 2]) / 8.0;
                }
                sum += x;
                squares += x * x;
            }
        mean = sum / n;
        variance = (squares / n - mean * mean) * n / (n - 1.0);
        error = std::sqrt(variance / n);
    }
};

double smooth(double x, double y, double z) { return std::exp(-x) * (1.0 + y * y) * (0.5 + z); }
const double smooth_mean = (1.0 - std::exp(-1.0)) * (4.0 / 3.0);
double cut(double x, double y, double z) { return x + y + z < 1.0 ? 1.0 : 0.0; }
double rare(double x, double y, double) { return x * x + y * y < 0.01 ? 1.0 : 0.0; }

// 3 functions at 3 dimensions, |z| ≤ 4.5: 9 comparisons a sampler.
TYPED_TEST(SamplerNumbers, MeansOfReplicatesAreUnbiased) {
    double largest = 0.0;
    for (const std::size_t dimension : {0u, 2u, 126u}) {
        const auto check = [&](const auto& f, double exact, const char* name) {
            const ReplicateMeans<TypeParam> found(f, dimension);
            const double z = (found.mean - exact) / found.error;
            EXPECT_LE(std::abs(z), 4.5) << name << " from dimension " << dimension << ": " << found.mean << " ± " << found.error
                                        << ", exactly " << exact;
            largest = std::max(largest, std::abs(z));
        };
        check(smooth, smooth_mean, "smooth");
        check(cut, 1.0 / 6.0, "cut");
        check(rare, 0.01 * std::atan(1.0), "rare");
    }
    std::printf("largest |z| of 9: %.2f\n", largest);
}

// And their variance is that of 8 independent samples, or less where the points are spread evenly: within each group of four
// dimensions. For independent samples it is known: 5/36 / 8 for the cut.
TEST(SobolNumbers, PointsHaveLessVarianceThanIndependentOnes) {
    for (const std::size_t dimension : {0u, 4u, 20u}) {
        const double by_independent = ReplicateMeans<Independent>(smooth, dimension).variance,
                     by_sobol = ReplicateMeans<Sobol>(smooth, dimension).variance;
        const double cut_independent = ReplicateMeans<Independent>(cut, dimension).variance,
                     cut_sobol = ReplicateMeans<Sobol>(cut, dimension).variance;
        std::printf("from dimension %2zu: variance of Sobol over that of independent points: smooth %.3f, cut %.3f\n", dimension,
                    by_sobol / by_independent, cut_sobol / cut_independent);
        EXPECT_LT(by_sobol, 0.25 * by_independent);
        EXPECT_LT(cut_sobol, 0.8 * cut_independent);
        EXPECT_NEAR(cut_independent / (5.0 / 36.0 / 8.0), 1.0, 0.05);
    }
}

// Of the points of a replicate, one lies in each of its equal parts, in every scrambled dimension; and one in each box of the same
// area, of any shape, in the first two dimensions of each group of four together.
TEST(SobolNumbers, EveryReplicateIsStratified) {
    constexpr std::size_t dimensions = 128, group = SobolPoints::dimensions;
    for (const std::uint32_t size : {1u, 2u, 4u, 8u, 16u, 64u}) {
        const SobolPoints points(size);
        for (std::uint32_t pixel = 0; pixel < 4; ++pixel) {
            Sampler sampler(points, seed, pixel);
            for (std::uint64_t replicate = 0; replicate < 4; ++replicate) {
                std::vector<std::set<std::uint32_t>> strata(dimensions);
                std::vector<std::set<std::array<std::uint32_t, 3>>> boxes;
                for (std::uint32_t columns = 1; columns <= size; columns *= 2) boxes.emplace_back();
                for (std::uint64_t i = replicate * size; i < (replicate + 1) * size; ++i) {
                    std::vector<double> u(dimensions);
                    sampler.start(i);
                    for (double& x : u) x = sampler.next();
                    for (std::size_t d = 0; d < dimensions; ++d) strata[d].insert(static_cast<std::uint32_t>(u[d] * size));
                    for (std::uint32_t d = 0; d < dimensions; d += group)
                        for (std::size_t k = 0; k < boxes.size(); ++k)
                            boxes[k].insert({d, static_cast<std::uint32_t>(u[d] * (1u << k)),
                                             static_cast<std::uint32_t>(u[d + 1] * (size >> k))});
                }
                for (std::size_t d = 0; d < dimensions; ++d) ASSERT_EQ(strata[d].size(), size) << "dimension " << d;
                for (std::size_t k = 0; k < boxes.size(); ++k)
                    ASSERT_EQ(boxes[k].size(), dimensions / group * size) << (1u << k) << " columns";
            }
        }
    }
}

// The groups' points come in orders of their own: between dimensions of different groups there is no correlation, and none of
// ranks. 65,536 replicates of 8 points, 6 pairs.
TEST(SobolNumbers, GroupsOfDimensionsAreIndependent) {
    constexpr std::uint32_t size = 8;
    const std::vector<std::pair<std::size_t, std::size_t>> pairs{{0, 4}, {1, 5}, {3, 7}, {0, 8}, {4, 8}, {2, 125}};
    std::vector<std::vector<double>> counts(pairs.size(), std::vector<double>(size * size));
    for (std::uint32_t pixel = 0; pixel < 256; ++pixel)
        for (std::uint64_t replicate = 0; replicate < 256; ++replicate) {
            // One point of each: those of a replicate are not independent of each other.
            const auto u = numbers<Sobol>(seed, pixel, size * replicate + pixel % size, 128);
            for (std::size_t k = 0; k < pairs.size(); ++k)
                ++counts[k][static_cast<std::size_t>(u[pairs[k].first] * size) * size +
                            static_cast<std::size_t>(u[pairs[k].second] * size)];
        }
    for (std::size_t k = 0; k < pairs.size(); ++k)
        EXPECT_GT(chi_squared_p(counts[k]), rejected) << "dimensions " << pairs[k].first << " and " << pairs[k].second;
}

// Owen's scrambling: of two points that differ first in their k-th digit, the digits above are alike, the k-th differ, and all else
// is independent and uniform. 65,536 replicates, for each pair with the first point in two dimensions; which digit it is depends on
// the order of the points.
TEST(SobolNumbers, TwoPointsOfAReplicateAreScrambledAsOwenSays) {
    double smallest = 1.0;
    int tests = 0;
    for (const std::size_t dimension : {0u, 5u})
        for (std::uint64_t other = 1; other < 8; ++other) {
            constexpr std::uint32_t bins = 16;
            std::vector<double> counts(bins * bins);
            for (std::uint32_t pixel = 0; pixel < 256; ++pixel)
                for (std::uint64_t replicate = 0; replicate < 256; ++replicate) {
                    const auto x =
                        static_cast<std::uint32_t>(numbers<Sobol>(seed, pixel, 8 * replicate, dimension + 1)[dimension] * bins);
                    const auto y = static_cast<std::uint32_t>(
                        numbers<Sobol>(seed, pixel, 8 * replicate + other, dimension + 1)[dimension] * bins);
                    ++counts[x * bins + y];
                }
            std::map<int, std::vector<double>> by_digit;
            for (std::uint32_t x = 0; x < bins; ++x)
                for (std::uint32_t y = 0; y < bins; ++y) by_digit[std::bit_width(x ^ y)].push_back(counts[x * bins + y]);
            for (const auto& [digit, possible] : by_digit) {
                const double sum = std::accumulate(possible.begin(), possible.end(), 0.0);
                if (digit < 2) {
                    EXPECT_EQ(sum, 0.0) << "8 points differ in their first three digits";
                }
                if (sum == 0.0) continue;
                const double p = chi_squared_p(possible);
                EXPECT_GT(p, rejected) << "points 0 and " << other << ", dimension " << dimension << ", digit " << digit;
                smallest = std::min(smallest, p);
                ++tests;
            }
        }
    std::printf("smallest p-value of %d: %.2g\n", tests, smallest);
}

}  // namespace neumann::sampler_numbers_test
